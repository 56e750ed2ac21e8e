// `etendue compare`: read two pictures, compare them, report.
#include "command/compare.h"

#include "command/command_line.h"
#include "command/comparison_report.h"
#include "image/false_color.h"
#include "image/image_io.h"
#include "util/error.h"
#include "util/file.h"
#include "util/log.h"
#include "util/suggestion.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const COMPARE_EXAMPLES =
    "Examples:\n"
    "  etendue compare new.exr reference.exr\n"
    "  etendue compare new.exr reference.exr --html report.html --diff error.png\n"
    "  etendue compare a.png b.png --metrics mse,psnr\n"
    "  etendue compare a.exr b.exr --variance none --tile 16 --alpha 0.0001 --json -\n"
    "\n"
    "Exit codes: 0 no difference beyond the level, 5 the pictures differ or hold values that are\n"
    "not finite, 1 they cannot be compared, 4 a file cannot be read or written.";

struct CompareArguments {
    std::string a, b;
    std::string variance = "auto", metrics, html, json, diff;
    int tile = 8;
    double alpha = 1e-3;
    bool quiet = false, verbose = false;

    Verbosity verbosity() const { return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal; }
};

// Checks that the level is a probability that tests can have.
CLI::Validator probability()
{
    const auto check = [](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value > 0.0 && value < 1.0) return {};
        return fmt::format("must be between 0 and 1, both excluded, is \"{}\".", text);
    };
    return CLI::Validator(check, "");
}

CLI::Validator tile_size()
{
    const auto check = [](std::string& text) -> std::string {
        int value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= 1 && value <= 65536) return {};
        return fmt::format("must be a whole number of pixels between 1 and 65536, is \"{}\".", text);
    };
    return CLI::Validator(check, "");
}

void add_options(CLI::App& command, CompareArguments& a)
{
    command.add_option("A", a.a, "Picture: .exr, .hdr, .png or .jpg")->type_name("FILE")->required();
    command.add_option("B", a.b, "Reference")->type_name("FILE")->required();
    command
        .add_option("--variance", a.variance,
                    "Noise of a tile. stderr: the standard errors that render writes into .exr files;\n"
                    "none: from the differences between the tile's pixels; auto: stderr if both have it")
        ->check(CLI::IsMember({"auto", "none", "stderr"}))
        ->type_name("SOURCE")
        ->capture_default_str();
    command.add_option("--tile", a.tile, "Width and height of a tile in pixels")
        ->check(tile_size())
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option("--metrics", a.metrics,
                    "What to print, of: mse, relmse, mape, max_relative, mean_error, psnr,\n"
                    "trimmed_relmse, top_share. Default: all")
        ->type_name("NAME,NAME");
    command
        .add_option("--alpha", a.alpha,
                    "Level: how often pictures of the same light may be said to differ, all tests\n"
                    "together")
        ->check(probability())
        ->type_name("P")
        ->capture_default_str();
    command.add_option("--html", a.html, "Write a page with verdict, numbers and pictures, in one file")
        ->type_name("FILE");
    command.add_option("--json", a.json, "Write everything as JSON; - is the standard output, without the table")
        ->type_name("FILE");
    command
        .add_option("--diff", a.diff,
                    "Write A - B: .exr the numbers, .png or .jpg in colours (blue: A is darker, red:\n"
                    "A is brighter)")
        ->type_name("FILE");
    command.add_flag("--quiet", a.quiet, "Show warnings and errors only");
    command.add_flag("-v,--verbose", a.verbose, "Show details");
}

// The names in a list with commas, or all. Throws UsageError with a suggestion.
std::vector<std::string> chosen_metrics(const std::string& list)
{
    std::vector<std::string> known;
    for (const MetricName& metric : metric_names()) known.emplace_back(metric.name);
    if (list.empty()) return known;
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        names.push_back(list.substr(begin, end - begin));
        if (std::count(known.begin(), known.end(), names.back()) == 0)
            throw UsageError("--metrics: " + unknown_name("metric", names.back(), known) + ".");
        begin = end + 1;
    }
    return names;
}

VarianceSource variance_source(const std::string& name)
{
    if (name == "stderr") return VarianceSource::standard_errors;
    return name == "none" ? VarianceSource::differences : VarianceSource::automatic;
}

std::string lower_extension(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

// Throw what writing would throw for want of a folder or format, before the work is done.
void check_outputs(const CompareArguments& arguments)
{
    for (const std::string& path : {arguments.html, arguments.json})
        if (!path.empty()) check_writable(path);
    if (arguments.diff.empty()) return;
    check_image_path(arguments.diff);
    if (lower_extension(arguments.diff) == ".hdr")
        throw UsageError(arguments.diff + ": .hdr has no negative numbers, which differences are; use .exr.");
}

// A - B, number by number.
Image difference_image(const Image& a, const Image& b)
{
    const std::vector<Vec3> picture = rgb_values(a), reference = rgb_values(b);
    Image image;
    image.width = a.width;
    image.height = a.height;
    image.x = a.x;
    image.y = a.y;
    image.full_width = a.full_width;
    image.full_height = a.full_height;
    image.channels = {"R", "G", "B"};
    for (std::size_t i = 0; i < picture.size(); ++i)
        for (int c = 0; c < 3; ++c) image.data.push_back(static_cast<float>(picture[i][c] - reference[i][c]));
    return image;
}

void write_difference(const ComparisonReport& report, const std::string& path)
{
    const Image &a = report.a.image, &b = report.b.image;
    write_image(lower_extension(path) == ".exr" ? difference_image(a, b) : signed_error_image(a, b, error_scale(a, b)),
                path);
}

int compare(const CompareArguments& arguments, const std::string& command)
{
    Log& log = standard_log();
    log.set_verbosity(arguments.verbosity());
    ComparisonReport report;
    report.metrics = chosen_metrics(arguments.metrics);
    report.settings = {variance_source(arguments.variance), arguments.tile, arguments.alpha};
    report.command = command;
    check_outputs(arguments);
    report.a = {arguments.a, read_image(arguments.a)};
    report.b = {arguments.b, read_image(arguments.b)};
    report.comparison = compare_images(report.a.image, report.b.image, report.settings);

    if (!arguments.html.empty()) write_file(arguments.html, comparison_html(report));
    if (!arguments.diff.empty()) write_difference(report, arguments.diff);
    if (arguments.json == "-")
        std::cout << comparison_json(report);
    else if (!arguments.json.empty())
        write_file(arguments.json, comparison_json(report));
    if (arguments.json != "-" && !arguments.quiet) std::cout << comparison_text(report);
    for (const std::string& path : {arguments.html, arguments.diff, arguments.json})
        if (!path.empty() && path != "-") log.info(fmt::format("wrote {}", path));
    if (report.comparison.passed()) return static_cast<int>(ExitCode::success);
    if (arguments.quiet) log.warning(verdict_text(report) + ".");
    return static_cast<int>(ExitCode::check);
}
} // namespace

void register_compare(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("compare", "Measure how far a picture is from a reference");
    command->footer(COMPARE_EXAMPLES);
    const auto arguments = std::make_shared<CompareArguments>();
    add_options(*command, *arguments);
    command->callback([arguments, command, &action] {
        action = [arguments, line = command_line(*command)] { return compare(*arguments, line); };
    });
}
} // namespace etendue
