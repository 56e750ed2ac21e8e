#include "util/error.h"
#include "util/file.h"

#include <filesystem>
#include <fstream>
#include <functional>

using namespace etendue;
namespace fs = std::filesystem;

namespace
{
// A fresh folder that disappears with the test.
struct TemporaryFolder {
    TemporaryFolder() : path(fs::path(ETENDUE_BINARY_DIR) / "file_test")
    {
        fs::remove_all(path);
        fs::create_directories(path);
    }
    ~TemporaryFolder() { fs::remove_all(path); }
    std::string operator/(const char* name) const { return (path / name).string(); }
    std::size_t file_count() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }
    fs::path path;
};

std::string message_of(const std::function<void()>& action)
{
    try {
        action();
    } catch (const FileError& e) {
        return e.what();
    }
    return "no error";
}
} // namespace

TEST_CASE("what is written is read again, byte for byte", "[host]")
{
    const TemporaryFolder folder;
    std::string content(3'000'001, '\0');
    for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 131 >> 3);
    write_file(folder / "a.bin", content);
    CHECK(read_file(folder / "a.bin") == content);
    write_file(folder / "a.bin", "");
    CHECK(read_file(folder / "a.bin").empty());
    CHECK(folder.file_count() == 1);
}

TEST_CASE("a file that cannot be read says why", "[host]")
{
    const TemporaryFolder folder;
    CHECK(message_of([&] { read_file(folder / "none"); }) == folder / "none" + std::string(": there is no such file."));
    CHECK(message_of([&] { read_file(folder.path.string()); }) ==
          folder.path.string() + ": this is a directory, not a file.");
}

TEST_CASE("a file that is too large is refused before it is read", "[host]")
{
    const TemporaryFolder folder;
    std::ofstream(folder / "large").close();
    fs::resize_file(folder / "large", std::uintmax_t{1} << 40);
    CHECK(message_of([&] { read_file(folder / "large", 256u << 20); }) ==
          folder / "large" + std::string(": the file is too large: it has 1048576 MiB, and at most 256 MiB are read."));
}

TEST_CASE("an endless device is read up to the limit", "[host]")
{
    CHECK(message_of([&] { read_file("/dev/zero", 4u << 20); }) ==
          "/dev/zero: the file is too large: it has more than that, and at most 4 MiB are read.");
}

TEST_CASE("a failing writer leaves the old file and nothing else", "[host]")
{
    const TemporaryFolder folder;
    write_file(folder / "picture.png", "old");
    const auto fail_half_way = [](const std::string& temporary) {
        CHECK(fs::path(temporary).extension() == ".png");
        std::ofstream(temporary) << "half";
        throw std::runtime_error("the disk is full");
    };
    CHECK_THROWS_WITH(replace_file(folder / "picture.png", fail_half_way), "the disk is full");
    CHECK(read_file(folder / "picture.png") == "old");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("a place that cannot be written says why, before the work and after it, and stays as it was", "[host]")
{
    const TemporaryFolder folder;
    using Use = std::function<void(const std::string&)>;
    for (const Use& use : {Use([](const std::string& path) { write_file(path, "x"); }), Use(check_writable)}) {
        const auto message = [&](const std::string& path) { return message_of([&] { use(path); }); };
        CHECK(message(folder / "no/a.txt") ==
              folder / "no/a.txt" + (": the folder " + (folder / "no") + " does not exist."));
        CHECK(message(folder.path.string()) == folder.path.string() + ": this is a directory, not a file.");
        CHECK(message("") == "\"\": an empty name cannot be written.");
    }
    // No user, root neither, can make files there.
    CHECK(message_of([] { check_writable("/proc/a.json"); }) == "/proc/a.json: the folder /proc cannot be written to.");
    CHECK_NOTHROW(check_writable(folder / "a.json"));
    CHECK_NOTHROW(check_writable("/dev/null"));
    CHECK(folder.file_count() == 0);
}
