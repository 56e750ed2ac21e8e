// Pictures as files, by OpenImageIO.
#pragma once

#include "image/image.h"
#include "math/color.h"

#include <cstdint>
#include <string>

namespace etendue
{
// For the formats of 8 bits only.
struct WriteOptions {
    ToneMap tone_map = ToneMap::srgb;
    double exposure_stops = 0.0;
};

struct WriteReport {
    std::uint64_t non_finite_values = 0; // of R, G and B; EXR keeps them, the other formats show 0
};

// Write a picture in the format of the extension:
//   .exr               float, every channel under its name, metadata as attributes, place within the whole film
//   .hdr               R, G, B as RGBE, rounded to nearest; negative values are 0
//   .png .jpg .jpeg    R, G, B tone-mapped to 8 bits; metadata as text
// Equal pictures give equal bytes. Written under a temporary name and renamed: nothing is left behind on failure.
// Throws UsageError (unknown extension, no R, G, B) and FileError.
WriteReport write_image(const Image& image, const std::string& path, const WriteOptions& options = {});

// The bytes of a .png of the picture, for what holds pictures within itself. Throws UsageError (no R, G, B).
std::string png_bytes(const Image& image, const WriteOptions& options = {});

// Throw what write_image would throw for this path: unknown extension, missing folder, or one that cannot be written
// to. For before the work is done.
void check_image_path(const std::string& path);

// Read a picture, the first of several in one file. EXR (float or half) and HDR as they are; the colours of integer
// formats are decoded from sRGB, their alpha is not. Metadata holds the textual attributes. Throws FileError: missing,
// not a picture, damaged, or without R, G, B.
Image read_image(const std::string& path);
} // namespace etendue
