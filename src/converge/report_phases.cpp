// What was done and what it cost, in cells.
#include "converge/number_text.h"
#include "converge/report_tables.h"
#include "util/html.h"
#include "util/revision.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Rows = std::vector<std::vector<HtmlCell>>;

std::vector<HtmlCell> start_row(const std::string& name, const char* kernels, const StartSeconds& s)
{
    return {name,
            kernels,
            seconds_text(s.load),
            seconds_text(s.geometry),
            seconds_text(s.open),
            seconds_text(s.upload),
            seconds_text(s.bvh),
            seconds_text(s.compile),
            seconds_text(s.first_launch),
            seconds_text(s.total())};
}

std::string device_text(const StudiedConfiguration& studied)
{
    std::string text;
    for (const DeviceInfo& device : studied.prepared.options.devices)
        text += (text.empty() ? "" : " + ") + device.name + " (" + device.platform_version + ", driver " +
                device.driver_version + ")";
    return text;
}

std::string canary_text(const StudiedConfiguration& studied)
{
    if (studied.runs.empty()) return "not asked";
    std::string text;
    for (const DeviceReport& device : studied.runs.back().measurement.report.devices)
        text += (text.empty() ? "" : "; ") +
                (device.canary.passed ? std::string("yes, by the canary") : device.canary.complaint());
    return text;
}

std::string reference_text(const Reference& reference)
{
    if (reference.kind == Reference::Kind::none || !reference.knows_error) return reference.description + ".";
    return fmt::format("{}{}. Its variance is {}, known to ±{}.", reference.description,
                       reference.from_cache ? ", kept from an earlier study" : "", short_text(reference.floor),
                       short_text(reference.floor_error));
}

std::string machine_text(const Study& study)
{
    const MachineState &before = study.before, &after = study.after;
    return fmt::format(
        "{}; load {:.2f} before and {:.2f} after; clocks: median {:.0f} and {:.0f} MHz, least {:.0f} and "
        "{:.0f} MHz",
        before.processor.empty() ? "unknown processor" : before.processor, before.load_average, after.load_average,
        before.median_mhz, after.median_mhz, before.least_mhz, after.least_mhz);
}
} // namespace

std::string phase_tables(const Study& study)
{
    Rows starts, renders;
    for (const StudiedConfiguration& studied : study.configurations) {
        const std::string& name = studied.prepared.configuration.name;
        starts.push_back(start_row(name, "compiled", studied.cold));
        if (!studied.runs.empty()) starts.push_back(start_row(name, "kept", studied.runs.back().measurement.start));
        for (const Run& run : studied.runs) {
            const ErrorRow& last = run.rows.back();
            renders.push_back({name, std::to_string(run.seed), std::to_string(last.samples),
                               seconds_text(last.render_seconds), seconds_text(last.kernel_seconds),
                               seconds_text(run.measurement.look_seconds),
                               short_text(static_cast<double>(last.rays) / last.render_seconds * 1e-6)});
        }
    }
    return html_table("Before the first sample: with every kernel compiled as if never seen before, and with what the "
                      "program and the driver kept.",
                      {"configuration", "kernels", "load", "geometry", "open", "upload", "BVH", "compile",
                       "first launch", "all"},
                      starts) +
           html_table(
               "Rendering, from the end of the first launch. Kernels: by the device's own clock. Looking: reading "
               "the film and working out errors, while the clock stands still.",
               {"configuration", "seed", "samples", "rendering", "kernels", "looking", "Mrays/s"}, renders);
}

std::string self_check_table(const Study& study)
{
    Rows rows;
    for (const SelfCheckResult& r : study.self_check)
        rows.push_back({r.name, fmt::format("{:.6g}", r.expected), fmt::format("{:.6g}", r.found),
                        short_text(r.standard_error),
                        HtmlCell(fmt::format("{:+.1f}", r.z()), r.passed ? HtmlMark::good : HtmlMark::bad)});
    return html_table(
        "A room whose walls emit 1 and reflect 1/2, where paths survive with probability q: the error of N "
        "samples and the variance times rays are known.",
        {"number", "expected", "found", "standard error", "z"}, rows);
}

std::string setting_list(const Study& study)
{
    const StudiedConfiguration& first = study.configurations.front();
    const Scene& scene = first.prepared.scene;
    std::vector<HtmlDefinition> list;
    list.push_back({"scene", scene.file});
    list.push_back({"SHA-256 of the scene", scene.sha256});
    list.push_back({"picture", fmt::format("{} × {} pixels", scene.film.width, scene.film.height)});
    list.push_back({"checkpoints", study.options.checkpoints.text()});
    list.push_back({"seeds", fmt::format("{} from {}", study.options.seeds, study.options.first_seed)});
    std::string last;
    for (const StudiedConfiguration& studied : study.configurations) {
        list.push_back({"configuration", studied.prepared.configuration.text()});
        list.push_back({"device", device_text(studied)});
        list.push_back({"strict floating point", canary_text(studied)});
        if (!studied.reference || studied.reference->description == last) continue;
        last = studied.reference->description;
        list.push_back({"reference", reference_text(*studied.reference)});
    }
    const MetricSettings& settings = study.options.metric_settings;
    list.push_back({"relative errors", fmt::format("over √(r² + ({:g} × mean r)²)", settings.relative_epsilon)});
    list.push_back({"machine", machine_text(study)});
    list.push_back({"duration", seconds_text(study.seconds)});
    list.push_back({"etendue", fmt::format("{}, revision {}", ETENDUE_VERSION, REVISION)});
    return html_definitions(list);
}
} // namespace etendue
