// `etendue check`: choose, run, print each result as it comes.
#include "command/check.h"

#include "check/check_json.h"
#include "check/device_functions.h"
#include "check/run.h"
#include "check/table.h"
#include "command/check_arguments.h"
#include "command/command_line.h"
#include "compute/device.h"
#include "util/file.h"
#include "util/interrupt.h"
#include "util/log.h"
#include "util/progress.h"
#include "util/stopwatch.h"

#include <iostream>
#include <memory>
#include <random>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const CHECK_EXAMPLES =
    "Examples:\n"
    "  etendue check                         everything that is quick\n"
    "  etendue check analytic --only 'F*'    furnaces\n"
    "  etendue check scenes/stiff --long     the scenes of a folder\n"
    "  etendue check --seed fresh --budget 600 --json check.json\n"
    "\n"
    "Exit code 5 when a check fails, when one is too weak to see a bias of --delta, or when there was no time for\n"
    "one. Ctrl-C prints what there is (exit code 130).";

void print(Log& log, const std::string& text)
{
    log.set_status("");
    std::cout << text << std::endl;
}

void list_checks(const std::vector<Check>& checks)
{
    for (const Check& check : checks)
        std::cout << fmt::format("{:<10}{:<44}{:<6}{} statistical tests\n", check.group, check.name,
                                 check.is_long ? "long" : "quick", check.statistical_tests);
}

std::uint64_t fresh_seed()
{
    std::random_device source;
    return ((static_cast<std::uint64_t>(source()) << 32u) | source()) & MAX_CHECK_SEED;
}

CheckContext make_context(const CheckArguments& arguments)
{
    CheckContext context;
    context.lanes = arguments.lanes;
    context.specialize = arguments.specialize == "on";
    context.delta = arguments.delta;
    context.seed = arguments.seed == "fresh" ? fresh_seed() : 0;
    context.cache = (arguments.no_cache ? KernelCache::none() : KernelCache::standard()).remembering();
    context.stop = interrupted;
    return context;
}

// "12/150 F1-...  0:12, about 0:40 left": every check is taken to last as long as those so far.
std::string status_line(std::size_t index, std::size_t count, const Check& check, double seconds)
{
    const double left = seconds * static_cast<double>(count - index) / static_cast<double>(index);
    return fmt::format("{}/{} {}  {}, about {} left", index + 1, count, check.name, format_duration(seconds),
                       format_duration(left));
}

RunResult run_on(const DeviceInfo& info, const std::vector<Check>& checks, const Family& family, RunOptions options,
                 const CheckArguments& arguments, Log& log)
{
    const Device device(info);
    // What the checks have built for the device goes before it.
    const std::unique_ptr<const Device, void (*)(const Device*)> programs(
        &device, [](const Device*) { release_device_functions(); });
    options.context.device = &device;
    print(log, fmt::format("{} ({})\n{}", info.name, info.platform_name, table_header()));
    const Stopwatch watch;
    options.begun = [&](std::size_t index, const Check& check) {
        log.set_status(status_line(index, checks.size(), check, watch.seconds()));
    };
    options.finished = [&](const CheckResult& result) {
        if (!arguments.quiet || result.verdict != Verdict::passed) print(log, table_row(result));
    };
    RunResult run = run_checks(checks, family, options);
    print(log, table_summary(run, family));
    return run;
}

// The first of the devices that was interrupted ends the run.
std::vector<RunResult> run_all(const std::vector<Check>& checks, const Family& family, const RunOptions& options,
                               const std::vector<DeviceInfo>& devices, const CheckArguments& arguments, Log& log)
{
    std::vector<RunResult> runs;
    RunOptions rest = options;
    for (const DeviceInfo& info : devices) {
        runs.push_back(run_on(info, checks, family, rest, arguments, log));
        if (runs.back().interrupted) break;
        if (rest.budget) *rest.budget -= runs.back().seconds;
    }
    return runs;
}

int exit_code(const std::vector<RunResult>& runs)
{
    for (const RunResult& run : runs)
        if (run.interrupted) return static_cast<int>(ExitCode::interrupted);
    for (const RunResult& run : runs)
        if (!run.passed()) return static_cast<int>(ExitCode::check);
    return static_cast<int>(ExitCode::success);
}

int check(const CheckArguments& arguments, const std::string& command_line)
{
    Log& log = standard_log();
    if (arguments.quiet) log.set_verbosity(Verbosity::quiet);
    if (!arguments.json.empty()) check_writable(arguments.json);
    std::size_t left_out = 0;
    const std::vector<Check> checks = chosen_checks(arguments, left_out);
    if (arguments.list) {
        list_checks(checks);
        return static_cast<int>(ExitCode::success);
    }
    const DeviceList list = list_devices();
    const std::vector<DeviceInfo> devices = select_devices(list, arguments.device);
    for (const std::string& warning : list.warnings) log.warning(warning);

    const InterruptGuard guard;
    RunOptions options;
    options.context = make_context(arguments);
    options.fresh_seeds = arguments.seed == "fresh";
    options.budget = arguments.budget;
    const Family family = make_family(checks, arguments.alpha, devices.size());
    if (options.fresh_seeds) print(log, fmt::format("seed {}", options.context.seed));
    const std::vector<RunResult> runs = run_all(checks, family, options, devices, arguments, log);
    if (left_out > 0) print(log, fmt::format("{} checks that take long were left out; --long runs them.", left_out));
    if (!arguments.json.empty()) write_file(arguments.json, check_json(runs, family, options.context, command_line));
    return exit_code(runs);
}
} // namespace

void register_check(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("check", "Check this program on this device against closed forms");
    command->footer(CHECK_EXAMPLES);
    const auto arguments = std::make_shared<CheckArguments>();
    add_check_options(*command, *arguments);
    command->callback([arguments, command, &action] {
        action = [arguments, line = command_line(*command)] { return check(*arguments, line); };
    });
}
} // namespace etendue
