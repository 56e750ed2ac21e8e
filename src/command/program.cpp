#include "command/program.h"
#include "command/check.h"
#include "command/compare.h"
#include "command/converge.h"
#include "command/devices.h"
#include "command/render.h"
#include "command/replay.h"
#include "command/schema.h"
#include "util/error.h"

#include <CLI/CLI.hpp>

#include <functional>

namespace etendue
{
int run_program(int argc, char** argv)
{
    CLI::App app("etendue renders scenes by path tracing on whatever OpenCL device there is, and knows its error.",
                 "etendue");
    app.set_version_flag("--version", "etendue " ETENDUE_VERSION);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 success, 1 usage, 2 scene, 3 device, 4 file, 5 a check failed, 130 interrupted.\n"
               "`etendue COMMAND --help` tells more about a command.");
    std::function<int()> action;
    register_render(app, action);
    register_replay(app, action);
    register_converge(app, action);
    register_check(app, action);
    register_devices(app, action);
    register_compare(app, action);
    register_schema(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    return action();
}
} // namespace etendue
