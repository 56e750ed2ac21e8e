// Lines of comma-separated values, numbers with all their digits.
#include "converge/errors_csv.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

std::string device_names(const PreparedConfiguration& prepared)
{
    std::string names;
    for (const DeviceInfo& device : prepared.options.devices) names += (names.empty() ? "" : " + ") + device.name;
    return names;
}

std::string line(const StudiedConfiguration& studied, const Run& run, const ErrorRow& row)
{
    const Metrics& m = row.metrics;
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                       quoted(studied.prepared.scene.file), quoted(studied.prepared.configuration.name),
                       quoted(device_names(studied.prepared)), run.seed, row.samples, row.render_seconds,
                       row.kernel_seconds, studied.cold.total() + row.render_seconds, row.rays, m.mse, row.mse,
                       m.relmse, m.mape, m.max_relative, m.mean_error, studied.reference->floor, row.bad.nan,
                       row.bad.infinite, row.bad.negative, m.top_share, row.var_mean, row.relmse, row.film_error,
                       row.accidents);
}
} // namespace

const std::vector<std::pair<std::string, std::string>>& csv_columns()
{
    static const std::vector<std::pair<std::string, std::string>> columns{
        {"scene", "the scene file"},
        {"config", "the configuration"},
        {"device", "the device, or several with + between"},
        {"seed", "of the random numbers"},
        {"spp", "samples per pixel so far"},
        {"t_render", "seconds of rendering so far, looking at the film excluded"},
        {"t_kernel", "seconds of the kernels so far by the devices' own clocks, summed over devices"},
        {"t_total", "t_render and the cold start before it"},
        {"rays", "rays so far"},
        {"mse", "mean over pixels and channels of (x - r)^2, as measured"},
        {"mse_corrected", "mse - ref_var"},
        {"relmse", "mean of (x - r)^2 / (r^2 + (epsilon mean r)^2), as measured"},
        {"mape", "mean of |x - r| / sqrt(r^2 + (epsilon mean r)^2)"},
        {"maxrel", "the largest of the same"},
        {"bias", "mean of x - r"},
        {"ref_var", "mean variance of the reference"},
        {"nan", "values of the picture that are NaN"},
        {"inf", "values of the picture that are infinite"},
        {"neg", "values of the picture that are negative"},
        {"max_share", "share of mse that the worst 0.1 % of the pixels carry"},
        {"var_mean", "variance of the picture's mean, by the film's own estimate"},
        {"relmse_corrected", "relmse without the reference's variance"},
        {"film_error", "relative error as the film estimates it; sqrt(relmse_corrected) is the true one"},
        {"accidents", "samples that counted as zero because they were not finite, negative or impossible"}};
    return columns;
}

std::string errors_csv(const Study& study)
{
    std::string text;
    for (const auto& [name, meaning] : csv_columns()) text += (text.empty() ? "" : ",") + name;
    text += '\n';
    for (const StudiedConfiguration& studied : study.configurations)
        for (const Run& run : studied.runs)
            for (const ErrorRow& row : run.rows) text += line(studied, run, row);
    return text;
}
} // namespace etendue
