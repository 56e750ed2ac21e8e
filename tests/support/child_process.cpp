// Children by the shell, with their output in files.
#include "support/child_process.h"

#include "util/file.h"

#include <cstdlib>
#include <random>
#include <system_error>

#include <sys/wait.h>

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string quote(const std::string& text)
{
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted += '\'';
}
} // namespace

ChildResult run_child(const std::string& program, const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment)
{
    const TemporaryFolder folder;
    const std::string output = (folder.path() / "output").string(), errors = (folder.path() / "errors").string();
    std::string command = "env";
    for (const auto& [name, value] : environment) command += ' ' + quote(name + '=' + value);
    command += ' ' + quote(program);
    for (const std::string& argument : arguments) command += ' ' + quote(argument);
    command += fmt::format(" > {} 2> {} < /dev/null", quote(output), quote(errors));

    const int status = std::system(command.c_str());
    ChildResult result;
    if (WIFEXITED(status))
        result.exit_code = WEXITSTATUS(status);
    else if (WIFSIGNALED(status))
        result.exit_code = 128 + WTERMSIG(status);
    result.output = read_file(output);
    result.errors = read_file(errors);
    return result;
}

TemporaryFolder::TemporaryFolder()
    : path_(std::filesystem::temp_directory_path() / fmt::format("etendue-test-{:08x}", std::random_device()()))
{
    std::filesystem::create_directory(path_);
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}
} // namespace etendue
