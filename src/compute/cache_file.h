// A file of the kernel cache: a binary behind its own checksum, so that a damaged one never reaches a driver.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace etendue
{
// Whether files can be made in the folder; creates it when it is missing. Never throws.
bool is_writable_folder(const std::filesystem::path& folder);

// The binary in the file; nothing when there is no file, or when it is damaged.
std::optional<std::vector<unsigned char>> read_cache_file(const std::filesystem::path& file);

// Throws FileError.
void write_cache_file(const std::filesystem::path& file, const std::vector<unsigned char>& binary);
} // namespace etendue
