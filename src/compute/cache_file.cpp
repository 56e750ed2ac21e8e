// Files of the kernel cache: the SHA-256 of the binary in hexadecimal, a line break, the binary.
#include "compute/cache_file.h"

#include "util/error.h"
#include "util/file.h"
#include "util/sha256.h"

#include <random>
#include <string>

#include <fmt/format.h>

namespace etendue
{
bool is_writable_folder(const std::filesystem::path& folder)
{
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    const std::filesystem::path probe = folder / fmt::format("write-test-{:08x}", std::random_device()());
    try {
        write_file(probe.string(), "");
    } catch (const FileError&) {
        return false;
    }
    std::filesystem::remove(probe, ignored);
    return true;
}

std::optional<std::vector<unsigned char>> read_cache_file(const std::filesystem::path& file)
{
    std::string content;
    try {
        content = read_file(file.string());
    } catch (const FileError&) {
        return {};
    }
    const auto end = content.find('\n');
    if (end == std::string::npos || content.substr(0, end) != sha256(std::string_view(content).substr(end + 1)))
        return {};
    return std::vector<unsigned char>(content.begin() + static_cast<std::ptrdiff_t>(end) + 1, content.end());
}

void write_cache_file(const std::filesystem::path& file, const std::vector<unsigned char>& binary)
{
    const std::string bytes(binary.begin(), binary.end());
    write_file(file.string(), sha256(bytes) + '\n' + bytes);
}
} // namespace etendue
