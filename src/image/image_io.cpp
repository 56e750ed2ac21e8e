// Encoding into memory, so that util/file can write the bytes at once; decoding straight from the file.
#include "image/image_io.h"

#include "image/tone_map.h"
#include "util/error.h"
#include "util/file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <memory>

namespace fs = std::filesystem;

namespace etendue
{
namespace
{
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

enum class Format { exr, hdr, png, jpeg };

constexpr int jpeg_quality = 95;

Format format_of(const std::string& path)
{
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") return Format::exr;
    if (extension == ".hdr") return Format::hdr;
    if (extension == ".png") return Format::png;
    if (extension == ".jpg" || extension == ".jpeg") return Format::jpeg;
    throw UsageError(fmt::format(
        "{}: no picture format has the extension \"{}\"; there are: .exr, .hdr, .png, .jpg, .jpeg.", path, extension));
}

const char* plugin(Format format)
{
    switch (format) {
    case Format::exr:
        return "exr";
    case Format::hdr:
        return "hdr";
    case Format::png:
        return "png";
    case Format::jpeg:
        return "jpg";
    }
    return "";
}

// Say what failed and why the library says it did.
[[noreturn]] void fail(const std::string& path, const char* what, std::string reason)
{
    while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
    throw FileError(path, fmt::format("{}: {}.", what, reason.empty() ? "no reason is known" : reason));
}

std::vector<unsigned char> encode(const std::string& path, Format format, ImageSpec spec, TypeDesc type,
                                  const void* data)
{
    // An empty date keeps the library from writing the time of day.
    if (!spec.find_attribute("DateTime")) spec.attribute("DateTime", "");
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<ImageOutput> output = ImageOutput::create(plugin(format));
    if (!output) fail(path, "cannot be encoded", OIIO::geterror());
    output->set_ioproxy(&memory);
    if (!output->open(path, spec) || !output->write_image(type, data) || !output->close())
        fail(path, "cannot be encoded", output->geterror());
    return bytes;
}

ImageSpec rgb_spec(const Image& image, TypeDesc type)
{
    return ImageSpec(image.width, image.height, 3, type);
}

std::vector<unsigned char> encode_exr(const Image& image, const std::string& path)
{
    ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()), TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.x = image.x;
    spec.y = image.y;
    spec.full_width = std::max(image.full_width, image.width);
    spec.full_height = std::max(image.full_height, image.height);
    spec.attribute("compression", "zip");
    for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
    return encode(path, Format::exr, spec, TypeDesc::FLOAT, image.data.data());
}

// Round to the nearest RGBE value (Ward 1991), of which a conversion that cuts off then keeps every bit.
void round_to_rgbe(float* rgb)
{
    constexpr double largest = 255.0 * 0x1p119;
    double values[3];
    for (int c = 0; c < 3; ++c)
        values[c] = std::isfinite(rgb[c]) ? std::clamp(static_cast<double>(rgb[c]), 0.0, largest) : 0.0;
    // The exponent is shared: eight bits below the leading one of the largest value, once that is rounded.
    int exponent = 0;
    std::frexp(*std::max_element(values, values + 3), &exponent);
    double step = std::ldexp(1.0, exponent - 8);
    if (std::round(*std::max_element(values, values + 3) / step) == 256.0) step *= 2;
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(std::round(values[c] / step) * step);
}

std::vector<unsigned char> encode_hdr(const Image& image, const std::string& path)
{
    const std::size_t channels[] = {image.channel("R"), image.channel("G"), image.channel("B")};
    std::vector<float> rgb;
    rgb.reserve(image.pixel_count() * 3);
    for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
        for (const std::size_t channel : channels) rgb.push_back(image.data[pixel * image.channels.size() + channel]);
        round_to_rgbe(&rgb[pixel * 3]);
    }
    return encode(path, Format::hdr, rgb_spec(image, TypeDesc::FLOAT), TypeDesc::FLOAT, rgb.data());
}

std::vector<unsigned char> encode_display(const Image& image, const std::string& path, Format format,
                                          const WriteOptions& options)
{
    const DisplayImage display = tone_map_image(image, options.tone_map, options.exposure_stops);
    ImageSpec spec = rgb_spec(image, TypeDesc::UINT8);
    if (options.tone_map == ToneMap::srgb) spec.attribute("oiio:ColorSpace", "sRGB");
    if (format == Format::jpeg) {
        spec.attribute("Compression", fmt::format("jpeg:{}", jpeg_quality));
        spec.attribute("jpeg:subsampling", "4:4:4");
        // JPEG has one text only.
        std::string text;
        for (const auto& [name, value] : image.metadata) text += fmt::format("{}: {}\n", name, value);
        if (!text.empty()) spec.attribute("ImageDescription", text);
    } else {
        for (const auto& [name, value] : image.metadata) spec.attribute(name, value);
    }
    return encode(path, format, spec, TypeDesc::UINT8, display.rgb.data());
}

std::uint64_t count_non_finite(const Image& image)
{
    std::uint64_t count = 0;
    for (const char* name : {"R", "G", "B"}) {
        const std::size_t channel = image.channel(name);
        for (std::size_t i = channel; i < image.data.size(); i += image.channels.size())
            if (!std::isfinite(image.data[i])) ++count;
    }
    return count;
}

bool is_colour(const std::string& channel)
{
    return channel == "R" || channel == "G" || channel == "B";
}

// Decode integers in double: value / largest, and colours from sRGB.
template<typename Integer>
void read_integers(ImageInput& input, Image& image, bool& read)
{
    std::vector<Integer> values(image.data.size());
    read = input.read_image(0, 0, 0, -1, OIIO::BaseTypeFromC<Integer>::value, values.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double encoded = static_cast<double>(values[i]) / std::numeric_limits<Integer>::max();
        const bool colour = is_colour(image.channels[i % image.channels.size()]);
        image.data[i] = static_cast<float>(colour ? srgb_decode(encoded) : encoded);
    }
}

// The attributes that a person or program wrote, not those that describe the encoding.
std::map<std::string, std::string> textual_metadata(const ImageSpec& spec)
{
    std::map<std::string, std::string> metadata;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        const bool of_encoding = name == "compression" || name.starts_with("oiio:") || name.starts_with("openexr:");
        if (attribute.type() == TypeDesc::STRING && !of_encoding) metadata[name] = attribute.get_string();
    }
    return metadata;
}
} // namespace

WriteReport write_image(const Image& image, const std::string& path, const WriteOptions& options)
{
    const Format format = format_of(path);
    const WriteReport report{count_non_finite(image)};
    std::vector<unsigned char> bytes;
    switch (format) {
    case Format::exr:
        bytes = encode_exr(image, path);
        break;
    case Format::hdr:
        bytes = encode_hdr(image, path);
        break;
    case Format::png:
    case Format::jpeg:
        bytes = encode_display(image, path, format, options);
        break;
    }
    write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return report;
}

std::string png_bytes(const Image& image, const WriteOptions& options)
{
    const std::vector<unsigned char> bytes = encode_display(image, "a picture in memory", Format::png, options);
    return {bytes.begin(), bytes.end()};
}

void check_image_path(const std::string& path)
{
    format_of(path);
    check_writable(path);
}

Image read_image(const std::string& path)
{
    std::error_code code;
    if (!fs::exists(path, code)) throw FileError(path, "there is no such file.");
    if (fs::is_directory(path, code)) throw FileError(path, "this is a directory, not a file.");
    // Colours that were not multiplied by alpha stay so.
    ImageSpec configuration;
    configuration.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<ImageInput> input = ImageInput::open(path, &configuration);
    if (!input) fail(path, "cannot be read as a picture", OIIO::geterror());

    const ImageSpec& spec = input->spec();
    if (spec.deep) throw FileError(path, "is a deep picture, which cannot be read.");
    Image image;
    image.width = spec.width;
    image.height = spec.height;
    image.x = spec.x - spec.full_x;
    image.y = spec.y - spec.full_y;
    image.full_width = spec.full_width;
    image.full_height = spec.full_height;
    image.channels = spec.channelnames;
    image.metadata = textual_metadata(spec);
    if (std::count_if(image.channels.begin(), image.channels.end(), is_colour) != 3)
        throw FileError(path,
                        fmt::format("has no channels R, G and B; there are: {}.", fmt::join(image.channels, ", ")));

    image.data.resize(image.pixel_count() * image.channels.size());
    bool read = false;
    if (spec.format == TypeDesc::UINT8)
        read_integers<std::uint8_t>(*input, image, read);
    else if (spec.format == TypeDesc::UINT16)
        read_integers<std::uint16_t>(*input, image, read);
    else
        read = input->read_image(0, 0, 0, -1, TypeDesc::FLOAT, image.data.data());
    if (!read) fail(path, "cannot be read as a picture", input->geterror());
    return image;
}
} // namespace etendue
