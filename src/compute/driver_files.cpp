// Checks of the files that drivers depend on: .icd files and PoCL's cache.
#include "compute/driver_files.h"

#include "compute/cache_file.h"
#include "util/environment.h"
#include "util/shared_library.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>

namespace etendue
{
namespace fs = std::filesystem;
namespace
{
fs::path vendors_folder()
{
    for (const char* variable : {"OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH"})
        if (const std::string value = environment(variable); !value.empty()) return value;
    return "/etc/OpenCL/vendors";
}

std::vector<fs::path> icd_files(const fs::path& place)
{
    std::error_code ignored;
    if (fs::is_regular_file(place, ignored) && place.extension() == ".icd") return {place};
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(place, ignored))
        if (entry.path().extension() == ".icd") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

fs::path pocl_cache_folder()
{
    if (const std::string folder = environment("POCL_CACHE_DIR"); !folder.empty()) return folder;
    if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty())
        return fs::path(cache) / "pocl" / "kcache";
    if (const std::string home = environment("HOME"); !home.empty())
        return fs::path(home) / ".cache" / "pocl" / "kcache";
    return {};
}

// A new folder with a name nobody can guess, removed when the process ends.
class TemporaryFolder
{
public:
    TemporaryFolder() : path_(fs::temp_directory_path() / fmt::format("etendue-pocl-{:08x}", std::random_device()()))
    {
        fs::create_directory(path_);
        fs::permissions(path_, fs::perms::owner_all);
    }
    ~TemporaryFolder()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};
} // namespace

std::vector<std::string> unloadable_drivers()
{
    std::vector<std::string> warnings;
    for (const fs::path& file : icd_files(vendors_folder())) {
        std::string library;
        std::ifstream stream(file);
        if (!std::getline(stream, library) || library.empty())
            warnings.push_back(fmt::format("{} names no driver library.", file.string()));
        else if (const std::string failure = load_failure(library); !failure.empty())
            warnings.push_back(fmt::format("The driver that {} names cannot be loaded: {}.", file.string(), failure));
    }
    return warnings;
}

std::string ensure_pocl_cache()
{
    const fs::path folder = pocl_cache_folder();
    if (folder.empty() || is_writable_folder(folder)) return "";
    try {
        static const TemporaryFolder temporary;
        set_environment("POCL_CACHE_DIR", temporary.path().string());
    } catch (const fs::filesystem_error&) {
        return fmt::format("PoCL cannot write its kernel cache {}, nor is there a temporary folder for it: set "
                           "POCL_CACHE_DIR to a folder that can be written.",
                           folder.string());
    }
    return fmt::format("PoCL cannot write its kernel cache {}, so kernels are compiled anew in every run: set "
                       "POCL_CACHE_DIR to a folder that can be written.",
                       folder.string());
}
} // namespace etendue
