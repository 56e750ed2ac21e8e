// Files as whole strings; writing by temporary name and rename.
#include "util/file.h"

#include "util/error.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace etendue
{
namespace
{
constexpr std::size_t CHUNK_SIZE = std::size_t{1} << 20;

[[noreturn]] void fail_too_large(const std::string& path, const std::string& size, std::uint64_t limit)
{
    throw FileError(path,
                    fmt::format("the file is too large: it has {}, and at most {} MiB are read.", size, limit >> 20));
}

std::string system_message(int code)
{
    return std::generic_category().message(code);
}

// A name in the same folder that no other process or thread uses, with the same extension.
fs::path temporary_name(const fs::path& path)
{
    static const unsigned process_tag = std::random_device{}();
    static std::atomic<unsigned> counter{0};
    const std::string name = fmt::format(".{}.{:08x}-{}.part", path.stem().string(), process_tag, counter++);
    return path.parent_path() / (name + path.extension().string());
}

// Removes the file at the end unless it was renamed.
struct TemporaryFile {
    explicit TemporaryFile(fs::path p) : path(std::move(p)) {}
    ~TemporaryFile()
    {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    fs::path path;
};

void check_place(const std::string& path)
{
    if (path.empty()) throw FileError("\"\"", "an empty name cannot be written.");
    std::error_code code;
    if (fs::is_directory(path, code)) throw FileError(path, "this is a directory, not a file.");
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, code))
        throw FileError(path, "the folder " + folder.string() + " does not exist.");
}

// A device or a pipe is written directly: renaming would replace it.
bool is_special(const std::string& path)
{
    std::error_code code;
    return fs::exists(path, code) && !fs::is_regular_file(path, code);
}
} // namespace

std::string read_file(const std::string& path, std::uint64_t limit)
{
    std::string content;

    // Ask the system what it is before opening.
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found) throw FileError(path, "there is no such file.");
    if (status.type() == fs::file_type::directory) throw FileError(path, "this is a directory, not a file.");
    if (status.type() == fs::file_type::regular) {
        const std::uintmax_t size = fs::file_size(path, code);
        if (!code && size > limit) fail_too_large(path, fmt::format("{} MiB", size >> 20), limit);
        if (!code) content.reserve(size);
    }

    // Read in chunks: pipes and devices do not tell their size.
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileError(path, "cannot be opened for reading: " + system_message(errno) + ".");
    std::vector<char> chunk(CHUNK_SIZE);
    while (file.read(chunk.data(), CHUNK_SIZE), file.gcount() > 0) {
        content.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
        if (content.size() > limit) fail_too_large(path, "more than that", limit);
    }
    if (file.bad()) throw FileError(path, "cannot be read: " + system_message(errno) + ".");
    return content;
}

void check_writable(const std::string& path)
{
    check_place(path);
    if (is_special(path)) return;
    // Permissions do not tell the whole truth: try.
    const TemporaryFile probe(temporary_name(path));
    if (!std::ofstream(probe.path)) {
        const std::string folder = fs::path(path).parent_path().string();
        throw FileError(path, "the folder " + (folder.empty() ? "." : folder) + " cannot be written to.");
    }
}

void replace_file(const std::string& path, const std::function<void(const std::string&)>& write)
{
    check_place(path);
    if (is_special(path)) return write(path);

    std::error_code code;

    const TemporaryFile temporary(temporary_name(path));
    write(temporary.path.string());
    fs::rename(temporary.path, path, code);
    if (code) throw FileError(path, "cannot be written: " + code.message() + ".");
}

void write_file(const std::string& path, std::string_view content)
{
    replace_file(path, [&](const std::string& temporary) {
        errno = 0;
        std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
        file.write(content.data(), static_cast<std::streamsize>(content.size()));
        file.close();
        if (!file) throw FileError(path, "cannot be written: " + system_message(errno) + ".");
    });
}
} // namespace etendue
