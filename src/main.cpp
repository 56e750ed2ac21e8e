// Parse the command line, run one command, and turn an Error into one message and an exit code.
#include "command/compare.h"
#include "command/converge.h"
#include "command/devices.h"
#include "command/render.h"
#include "command/schema.h"
#include "util/error.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <iostream>
#include <new>

namespace
{
int run(int argc, char** argv)
{
    CLI::App app("etendue renders scenes by path tracing on whatever OpenCL device there is, and knows its error.",
                 "etendue");
    app.set_version_flag("--version", "etendue " ETENDUE_VERSION);
    app.require_subcommand(1);
    app.footer("Exit codes: 0 success, 1 usage, 2 scene, 3 device, 4 file, 5 a check failed, 130 interrupted.\n"
               "`etendue COMMAND --help` tells more about a command.");
    std::function<int()> action;
    etendue::register_render(app, action);
    etendue::register_converge(app, action);
    etendue::register_devices(app, action);
    etendue::register_compare(app, action);
    etendue::register_schema(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(etendue::ExitCode::usage);
    }
    return action();
}
} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const etendue::Error& e) {
        std::cerr << "etendue: " << e.what() << '\n';
        return static_cast<int>(e.code());
    } catch (const std::bad_alloc&) {
        std::cerr << "etendue: This machine has not enough memory for the scene.\n";
        return static_cast<int>(etendue::ExitCode::scene);
    } catch (const std::exception& e) {
        std::cerr << "etendue: The system refused something: " << e.what() << ".\n";
        return static_cast<int>(etendue::ExitCode::device);
    }
}
