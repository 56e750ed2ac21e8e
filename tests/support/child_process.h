// Runs a program as a user would, in an environment of its own.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace etendue
{
struct ChildResult {
    int exit_code = -1; // 128 + signal when a signal ended it
    std::string output; // stdout
    std::string errors; // stderr
};

// Wait for `program` with these arguments; `environment` is added to that of this process.
ChildResult run_child(const std::string& program, const std::vector<std::string>& arguments,
                      const std::map<std::string, std::string>& environment = {});

// A new empty folder, removed with all it holds at the end of the scope.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};
} // namespace etendue
