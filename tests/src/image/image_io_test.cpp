// Pictures that go to a file and come back, and what a file must never do.
#include "image/image_io.h"
#include "util/error.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <thread>

namespace fs = std::filesystem;
using namespace etendue;

namespace
{
// A folder of its own for each test, gone at the end.
struct Folder {
    Folder()
    {
        std::random_device random;
        path = fs::temp_directory_path() / ("etendue_image_io_" + std::to_string(random()));
        fs::create_directory(path);
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string operator/(const std::string& name) const { return (path / name).string(); }
    std::size_t file_count() const
    {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }
    fs::path path;
};

std::string bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Image rgb_image(int width, int height, std::vector<float> data)
{
    return {width, height, 0, 0, width, height, {"R", "G", "B"}, std::move(data), {}};
}

Image grey_image(float value)
{
    return rgb_image(1, 1, {value, value, value});
}

bool same_bits(float a, float b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// The first pixel's red as 8 bits, without etendue's decoding.
int first_byte(const std::string& path)
{
    const auto input = OIIO::ImageInput::open(path);
    REQUIRE(input);
    std::vector<unsigned char> pixels(static_cast<std::size_t>(input->spec().image_pixels()) *
                                      static_cast<std::size_t>(input->spec().nchannels));
    REQUIRE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, pixels.data()));
    return pixels[0];
}

void write_raw(const std::string& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* data)
{
    const auto output = OIIO::ImageOutput::create(path);
    REQUIRE(output);
    REQUIRE(output->open(path, spec));
    REQUIRE(output->write_image(type, data));
    REQUIRE(output->close());
}
} // namespace

TEST_CASE("an EXR keeps every bit of every channel, non-finite ones included")
{
    const Folder folder;
    std::mt19937 random(5);
    Image image{5, 4, 0, 0, 5, 4, {"R", "G", "B", "stderr.R", "albedo.G", "normal.X", "depth.Z", "samples.Y"}, {}, {}};
    image.data.resize(image.pixel_count() * image.channels.size());
    for (float& value : image.data) {
        const std::uint32_t bits = static_cast<std::uint32_t>(random());
        std::memcpy(&value, &bits, sizeof value);
    }
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const float special[] = {1e8f, 1e-8f, nan, inf, -inf, -0.0f, 1e-45f, 3.4e38f};
    std::copy(std::begin(special), std::end(special), image.data.begin());

    const std::string path = folder / "all.exr";
    write_image(image, path);
    const Image back = read_image(path);
    REQUIRE(back.width == 5);
    REQUIRE(back.height == 4);
    REQUIRE(back.channels.size() == image.channels.size());
    for (std::size_t c = 0; c < image.channels.size(); ++c)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 5; ++x)
                CHECK(same_bits(image.at(x, y, c), back.at(x, y, back.channel(image.channels[c]))));
}

TEST_CASE("an EXR keeps metadata and the place of a crop within the film")
{
    const Folder folder;
    Image image{2, 3, 7, 1, 20, 10, {"R", "G", "B"}, std::vector<float>(18, 0.5f), {}};
    image.metadata = {{"etendue.seed", "12"}, {"etendue.device", "a \"device\", 2.0"}, {"Software", "etendue 0.1"}};
    const std::string path = folder / "crop.exr";
    write_image(image, path);
    const Image back = read_image(path);
    CHECK(back.x == 7);
    CHECK(back.y == 1);
    CHECK(back.width == 2);
    CHECK(back.height == 3);
    CHECK(back.full_width == 20);
    CHECK(back.full_height == 10);
    CHECK(back.metadata == image.metadata);
}

TEST_CASE("a PNG holds the 8 bits of the tone map and keeps metadata as text")
{
    const Folder folder;
    const std::string path = folder / "grey.png";
    Image image = grey_image(0.18f);
    image.metadata = {{"etendue.seed", "12"}, {"Software", "etendue 0.1"}};
    image.x = 3;
    image.full_width = 9;
    write_image(image, path);
    CHECK(first_byte(path) == 118);
    const Image back = read_image(path);
    CHECK(back.metadata == image.metadata);
    CHECK(back.x == 0);
    CHECK(back.full_width == 1);

    write_image(grey_image(0.5f), path);
    CHECK(first_byte(path) == 188);
    write_image(grey_image(0.5f), path, {ToneMap::gamma22, 0.0});
    CHECK(first_byte(path) == 186);
    write_image(grey_image(0.125f), path, {ToneMap::srgb, 2.0});
    CHECK(first_byte(path) == 188);
    write_image(grey_image(1e8f), path);
    CHECK(first_byte(path) == 255);
    write_image(grey_image(1e-8f), path);
    CHECK(first_byte(path) == 0);
}

TEST_CASE("a JPEG is near the tone map and keeps metadata as its description")
{
    const Folder folder;
    const std::string path = folder / "red.JPEG";
    Image image = rgb_image(16, 16, {});
    for (int i = 0; i < 256; ++i) image.data.insert(image.data.end(), {0.5f, 0.0f, 0.0f});
    image.metadata = {{"etendue.seed", "12"}};
    write_image(image, path);
    CHECK(std::abs(first_byte(path) - 188) <= 3);
    const auto metadata = read_image(path).metadata;
    REQUIRE(metadata.contains("ImageDescription"));
    CHECK(metadata.at("ImageDescription").starts_with("etendue.seed: 12"));
}

TEST_CASE("an HDR is within half a step of RGBE, over all magnitudes")
{
    const Folder folder;
    const std::string path = folder / "wide.hdr";
    Image image = rgb_image(1, 200, {});
    std::mt19937 random(6);
    std::uniform_real_distribution<float> mantissa(0.5f, 1.0f), share(0.0f, 1.0f);
    for (int i = 0; i < 200; ++i) {
        const float largest = std::ldexp(mantissa(random), i - 100);
        image.data.insert(image.data.end(), {largest * share(random), largest, largest * share(random)});
    }
    image.data[0] = image.data[1] = 255.9f; // rounds up to the next power of two, whose step is 2
    image.data[2] = 3.4f;
    write_image(image, path);
    const Image back = read_image(path);
    REQUIRE(back.data.size() == image.data.size());
    for (std::size_t pixel = 0; pixel < 200; ++pixel) {
        const float largest = *std::max_element(&image.data[pixel * 3], &image.data[pixel * 3] + 3);
        int exponent = 0;
        std::frexp(largest, &exponent);
        for (std::size_t c = 0; c < 3; ++c) {
            const double difference =
                std::abs(static_cast<double>(back.data[pixel * 3 + c]) - image.data[pixel * 3 + c]);
            // Half a step of 2^(exponent - 8), or of twice that where the largest rounds up.
            CHECK(difference <=
                  std::ldexp(1.0, exponent - 8) * (largest > std::ldexp(255.5, exponent - 8) ? 1.0 : 0.5));
        }
    }
    CHECK(back.data[0] == 256.0f);

    write_image(rgb_image(1, 1, {1e8f, -1.0f, 3.4e38f}), path);
    CHECK(read_image(path).data[1] == 0.0f);
    CHECK(read_image(path).data[2] == Approx(0x1.fep126f));
}

TEST_CASE("non-finite values are counted whatever the format, and shown as zero where there is none for them")
{
    const Folder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    Image image{2, 1, 0, 0, 2, 1, {"R", "G", "B", "stderr.R"}, {nan, 0.5f, 0.5f, inf, inf, -inf, 0.5f, inf}, {}};
    for (const char* name : {"a.exr", "a.hdr", "a.png", "a.jpg"})
        CHECK(write_image(image, folder / name).non_finite_values == 3);
    CHECK(std::isnan(read_image(folder / "a.exr").data[0]));
    CHECK(first_byte(folder / "a.png") == 0);
    CHECK(read_image(folder / "a.hdr").data[0] == 0.0f);
    CHECK(read_image(folder / "a.hdr").data[3] == 0.0f);
    CHECK(write_image(grey_image(1.0f), folder / "b.exr").non_finite_values == 0);
}

TEST_CASE("integers are decoded from sRGB, alpha is not, and colours stay as they are under alpha")
{
    const Folder folder;
    const unsigned char pixel8[] = {128, 0, 255, 51};
    write_raw(folder / "8.png", OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::UINT8), OIIO::TypeDesc::UINT8, pixel8);
    CHECK(read_image(folder / "8.png").data[0] == Approx(0.21586050).epsilon(1e-7));
    CHECK(read_image(folder / "8.png").data[1] == 0.0f);
    CHECK(read_image(folder / "8.png").data[2] == 1.0f);

    OIIO::ImageSpec with_alpha(1, 1, 4, OIIO::TypeDesc::UINT8);
    with_alpha.attribute("oiio:UnassociatedAlpha", 1);
    write_raw(folder / "a.png", with_alpha, OIIO::TypeDesc::UINT8, pixel8);
    const Image with = read_image(folder / "a.png");
    CHECK(with.data[0] == Approx(0.21586050).epsilon(1e-7));
    CHECK(with.data[with.channel("A")] == Approx(0.2));

    const std::uint16_t pixel16[] = {0x8080, 0, 0xffff};
    write_raw(folder / "16.png", OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::UINT16), OIIO::TypeDesc::UINT16, pixel16);
    CHECK(read_image(folder / "16.png").data[0] == Approx(0.21586050).epsilon(1e-7));
}

TEST_CASE("an EXR of half floats is read as it is")
{
    const Folder folder;
    const float pixel[] = {0.5f, 1.0f / 1024, 65504.0f};
    write_raw(folder / "half.exr", OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::HALF), OIIO::TypeDesc::FLOAT, pixel);
    const Image back = read_image(folder / "half.exr");
    CHECK(back.data == std::vector<float>(pixel, pixel + 3));
}

TEST_CASE("equal pictures give equal bytes, whenever they are written")
{
    const Folder folder;
    Image image = rgb_image(3, 2, std::vector<float>(18, 0.3f));
    image.metadata = {{"etendue.seed", "12"}};
    const std::string names[] = {"a.exr", "a.hdr", "a.png", "a.jpg"};
    for (const std::string& name : names) write_image(image, folder / name);
    // Times in these files count seconds.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    for (const std::string& name : names) {
        write_image(image, folder / ("later_" + name));
        CHECK(bytes_of(folder / name) == bytes_of(folder / ("later_" + name)));
        CHECK_FALSE(bytes_of(folder / name).empty());
    }
}

TEST_CASE("a failure leaves nothing behind and an older picture untouched")
{
    const Folder folder;
    const Image no_colours{1, 1, 0, 0, 1, 1, {"depth.Z"}, {1.0f}, {}};
    for (const char* name : {"a.exr", "a.hdr", "a.png", "a.jpg"}) {
        write_image(grey_image(0.5f), folder / name);
        const std::string before = bytes_of(folder / name);
        CHECK_THROWS_AS(write_image(no_colours, folder / name), UsageError);
        CHECK(bytes_of(folder / name) == before);
    }
    CHECK(folder.file_count() == 4);

    fs::create_directory(folder / "b.exr");
    CHECK_THROWS_AS(write_image(grey_image(0.5f), folder / "b.exr"), FileError);
    CHECK(folder.file_count() == 5);
}

TEST_CASE("paths that cannot be written are refused in words, early and late")
{
    const Folder folder;
    const auto refused = [](const std::string& path) {
        std::string early, late;
        try {
            check_image_path(path);
        } catch (const Error& error) {
            early = error.what();
        }
        try {
            write_image(grey_image(0.5f), path);
        } catch (const Error& error) {
            late = error.what();
        }
        CHECK(early == late);
        return early;
    };
    CHECK(refused(folder / "a.tga") ==
          (folder / "a.tga") +
              ": no picture format has the extension \".tga\"; there are: .exr, .hdr, .png, .jpg, .jpeg.");
    CHECK(refused("picture") ==
          "picture: no picture format has the extension \"\"; there are: .exr, .hdr, .png, .jpg, .jpeg.");
    CHECK(refused(folder / "missing/a.png") ==
          (folder / "missing/a.png") + ": the folder " + (folder / "missing") + " does not exist.");
    fs::create_directory(folder / "c.png");
    CHECK(refused(folder / "c.png") == (folder / "c.png") + ": this is a directory, not a file.");
    CHECK_THROWS_AS(check_image_path("a.tga"), UsageError);
    CHECK_THROWS_AS(check_image_path(folder / "missing/a.png"), FileError);

    CHECK_NOTHROW(check_image_path(folder / "fine.png"));
    CHECK(folder.file_count() == 1);
}

#ifdef __linux__
TEST_CASE("a folder that takes no files is said to be the reason")
{
    // Not even root writes here.
    CHECK_THROWS_WITH(check_image_path("/proc/self/a.png"),
                      "/proc/self/a.png: the folder /proc/self cannot be written to.");
    CHECK_THROWS_AS(check_image_path("/proc/self/a.png"), FileError);
    CHECK_THROWS_WITH(write_image(grey_image(0.5f), "/proc/self/a.png"),
                      Catch::Contains("/proc/self/a.png: cannot be written: "));
}
#endif

TEST_CASE("what is no picture is refused in words")
{
    const Folder folder;
    CHECK_THROWS_WITH(read_image(folder / "none.exr"), (folder / "none.exr") + ": there is no such file.");
    CHECK_THROWS_WITH(read_image(folder.path.string()), folder.path.string() + ": this is a directory, not a file.");
    std::ofstream(folder / "text.png") << "not a picture";
    CHECK_THROWS_WITH(read_image(folder / "text.png"), Catch::Contains("text.png: cannot be read as a picture: "));

    const unsigned char grey = 128;
    write_raw(folder / "grey.png", OIIO::ImageSpec(1, 1, 1, OIIO::TypeDesc::UINT8), OIIO::TypeDesc::UINT8, &grey);
    CHECK_THROWS_WITH(read_image(folder / "grey.png"),
                      (folder / "grey.png") + ": has no channels R, G and B; there are: Y.");
}

TEST_CASE("no cut of a picture file crashes the reader")
{
    const Folder folder;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    Image image = rgb_image(16, 16, std::vector<float>(768));
    for (float& value : image.data) value = uniform(random);
    for (const char* extension : {".exr", ".hdr", ".png"}) {
        const std::string path = folder / ("whole" + std::string(extension));
        write_image(image, path);
        const std::string bytes = bytes_of(path);
        const std::string cut = folder / ("cut" + std::string(extension));
        for (std::size_t size = 0; size < bytes.size() / 2; size += 37) {
            std::ofstream(cut, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
            CHECK_THROWS_AS(read_image(cut), FileError);
        }
    }
}
