// Reading whole files with clear errors, and writing them so that a half-written file never has the final name.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace etendue
{
inline constexpr std::uint64_t NO_SIZE_LIMIT = ~std::uint64_t{0};

// All bytes of a file. Throws FileError: missing, a directory, unreadable, or larger than `limit` bytes, which is found
// out before reading where the system knows the size.
std::string read_file(const std::string& path, std::uint64_t limit = NO_SIZE_LIMIT);

// Throw the FileError that writing `path` would end with, before the work is done whose result it shall hold: no name,
// a directory, a folder that does not exist or cannot be written to.
void check_writable(const std::string& path);

// Call write(temporary path), then rename that file to `path`. The temporary name is in the same folder and has the
// same extension. Whatever fails or throws, `path` is untouched and nothing is left behind. Throws FileError and what
// `write` throws.
void replace_file(const std::string& path, const std::function<void(const std::string& temporary)>& write);

// The same for content in memory.
void write_file(const std::string& path, std::string_view content);
} // namespace etendue
