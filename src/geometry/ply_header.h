// What the header of a PLY file declares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace etendue
{
enum class PlyEncoding { text, binary_little_endian, binary_big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; // lists only
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    // Bytes (a list: its count alone) that one element takes at least.
    std::size_t least_size(PlyEncoding encoding) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<PlyElement> elements; // in the order of the file
    std::string_view body;            // what follows the header
    std::size_t lines = 0;            // of the header
};

// Throws FileError naming file and line.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file);
} // namespace etendue
