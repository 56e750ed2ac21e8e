// `etendue converge`: study, analyse, write, say the verdict.
#include "command/converge.h"

#include "command/command_line.h"
#include "command/converge_arguments.h"
#include "converge/analysis.h"
#include "converge/study_files.h"
#include "util/interrupt.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace etendue
{
namespace
{
const char* const CONVERGE_EXAMPLES =
    "Examples:\n"
    "  etendue converge scenes/course-box/simple.json --out study\n"
    "  etendue converge room.json --out study --compare integrators\n"
    "  etendue converge room.json --out study --config off:integrator.roulette=off\n"
    "      --config on:integrator.roulette=constant --checkpoints time:0.1:60:x1.414\n"
    "  etendue converge --self-check\n"
    "\n"
    "The folder gets report.html, errors.csv, converge.json, plots and pictures. Exit code 5 when a\n"
    "verdict is BIASED or FAILED. Ctrl-C ends the study and reports what is done (exit code 130).";

std::string self_check_line(const SelfCheckResult& result)
{
    return fmt::format("{}: expected {:.6g}, found {:.6g}, {:+.1f} standard errors: {}", result.name, result.expected,
                       result.found, result.z(), result.passed ? "passed" : "NOT PASSED");
}

int check_bench(const ConvergeArguments& arguments, Log& log)
{
    RenderOptions options;
    options.devices = select_devices(list_devices(), arguments.device);
    options.cache = KernelCache::standard();
    const std::vector<SelfCheckResult> results = run_self_check(options, interrupted);
    for (const SelfCheckResult& result : results) log.info(self_check_line(result));
    if (interrupted()) return static_cast<int>(ExitCode::interrupted);
    return static_cast<int>(passed(results) ? ExitCode::success : ExitCode::check);
}

void summarise(const Analysis& analysis, Log& log)
{
    for (const ConfigurationAnalysis& configuration : analysis.configurations) {
        const BiasVerdict& verdict = configuration.verdict;
        if (configuration.curve.empty()) {
            log.info(fmt::format("{}: {}", configuration.name, fmt::join(verdict.reasons, " ")));
            continue;
        }
        log.info(fmt::format("{}: {}; slope {:.3f} [{:.3f}, {:.3f}], relMSE {:.3g} after {:.3g} s", configuration.name,
                             bias_result_name(verdict.result), configuration.slope_samples.estimate,
                             configuration.slope_samples.low, configuration.slope_samples.high,
                             configuration.curve.back().relmse.estimate, configuration.curve.back().render_seconds));
        for (const std::string& reason : verdict.reasons) log.info("  " + reason);
    }
}

int converge(const ConvergeArguments& arguments, const std::string& command_line)
{
    Log& log = standard_log();
    log.set_verbosity(arguments.verbosity());
    const InterruptGuard guard;
    if (arguments.self_check) return check_bench(arguments, log);

    StudyOptions options = study_options(arguments);
    options.command = command_line;
    options.stop = interrupted;
    make_study_folder(arguments.folder);
    const Study study = run_study(options, log);
    const Analysis analysis = analyse(study);
    write_study(study, analysis, arguments.folder);
    summarise(analysis, log);
    log.info(fmt::format("wrote {}", (std::filesystem::path(arguments.folder) / "report.html").string()));
    if (study.interrupted) return static_cast<int>(ExitCode::interrupted);
    return static_cast<int>(analysis.bad() ? ExitCode::check : ExitCode::success);
}
} // namespace

void register_converge(CLI::App& app, std::function<int()>& action)
{
    CLI::App* command = app.add_subcommand("converge", "Measure error against run time, with a verdict on bias");
    command->footer(CONVERGE_EXAMPLES);
    const auto arguments = std::make_shared<ConvergeArguments>();
    add_converge_options(*command, *arguments);
    command->callback([arguments, command, &action] {
        action = [arguments, line = command_line(*command)] { return converge(*arguments, line); };
    });
}
} // namespace etendue
