// The elements of a PLY file, from text or bytes by the same code.
#include "geometry/ply_reader.h"

#include "geometry/ply_header.h"
#include "geometry/ply_source.h"
#include "math/shared.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr std::size_t SKIP = 6;

// Where each property goes: x y z nx ny nz are 0 to 5.
std::vector<std::size_t> vertex_slots(const PlyElement& element, const std::string& file)
{
    constexpr std::array<std::string_view, SKIP> NAMES = {"x", "y", "z", "nx", "ny", "nz"};
    std::vector<std::size_t> slots;
    std::array<bool, SKIP> has{};
    for (const PlyProperty& property : element.properties) {
        const auto found =
            static_cast<std::size_t>(std::find(NAMES.begin(), NAMES.end(), property.name) - NAMES.begin());
        slots.push_back(property.is_list ? SKIP : found);
        if (slots.back() != SKIP) has[found] = true;
    }
    if (!has[0] || !has[1] || !has[2]) throw FileError(file, "element vertex needs the properties x, y and z.");
    if (has[3] && has[4] && has[5]) return slots;
    for (std::size_t& slot : slots) slot = slot >= 3 ? SKIP : slot;
    return slots;
}

template<class Source>
void skip_list(Source& source, const PlyProperty& list)
{
    const std::int64_t count = source.integer(list.count_type);
    if (count < 0) source.fail(fmt::format("list {} has {} items.", quote(list.name), count));
    for (std::int64_t i = 0; i < count; ++i) source.real(list.type);
}

template<class Source>
void read_vertices(Source& source, const PlyElement& element, const std::string& file, PolygonMesh& mesh)
{
    const std::vector<std::size_t> slots = vertex_slots(element, file);
    const bool has_normals = std::find(slots.begin(), slots.end(), 3u) != slots.end();
    mesh.positions.reserve(element.count);
    if (has_normals) mesh.normals.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        std::array<double, SKIP + 1> values{};
        source.begin_element(element, i);
        for (std::size_t p = 0; p < slots.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list)
                skip_list(source, property);
            else
                values[slots[p]] = source.real(property.type);
        }
        source.end_element();
        mesh.positions.emplace_back(values[0], values[1], values[2]);
        if (has_normals) mesh.normals.emplace_back(values[3], values[4], values[5]);
    }
}

template<class Source>
void read_corners(Source& source, const PlyProperty& list, std::uint64_t face, PolygonMesh& mesh)
{
    const std::int64_t size = source.integer(list.count_type);
    if (size < 3) source.fail(fmt::format("face {} has {} corners; a face needs at least three.", face, size));
    for (std::int64_t i = 0; i < size; ++i) {
        const std::int64_t index = source.integer(list.type);
        if (index < 0 || index >= std::int64_t{NO_INDEX})
            source.fail(fmt::format("face {} uses vertex {}, which is no index.", face, index));
        mesh.corners.push_back(static_cast<std::uint32_t>(index));
    }
    mesh.sizes.push_back(static_cast<std::uint32_t>(size));
}

template<class Source>
void read_faces(Source& source, const PlyElement& element, const std::string& file, PolygonMesh& mesh)
{
    const auto corners = std::find_if(element.properties.begin(), element.properties.end(), [](const PlyProperty& p) {
        return p.is_list && is_integer(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index");
    });
    if (corners == element.properties.end())
        throw FileError(file, "element face needs a list of integers \"vertex_indices\".");
    mesh.sizes.reserve(element.count);
    mesh.corners.reserve(std::min<std::size_t>(3 * element.count, source.remaining()));
    for (std::uint64_t i = 0; i < element.count; ++i) {
        source.begin_element(element, i);
        for (auto property = element.properties.begin(); property != element.properties.end(); ++property) {
            if (property == corners)
                read_corners(source, *property, i, mesh);
            else if (property->is_list)
                skip_list(source, *property);
            else
                source.real(property->type);
        }
        source.end_element();
    }
}

template<class Source>
void skip_elements(Source& source, const PlyElement& element)
{
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        source.begin_element(element, i);
        for (const PlyProperty& property : element.properties)
            if (property.is_list)
                skip_list(source, property);
            else
                source.real(property.type);
        source.end_element();
    }
}

// Hold the count of an element against what is left of the file, before anything is allocated for it.
void check_count(const PlyElement& element, PlyEncoding encoding, std::size_t remaining, const std::string& file)
{
    const std::size_t least = std::max<std::size_t>(element.least_size(encoding), 1);
    const std::size_t most = (remaining + 1) / least;
    if (element.count > most && !element.properties.empty())
        throw FileError(file,
                        fmt::format("the header claims {} elements {}, but the rest of the file can hold {} at most.",
                                    element.count, quote(element.name), most));
    if (element.count >= NO_INDEX) throw FileError(file, fmt::format("has too many elements {}.", quote(element.name)));
}

template<class Source>
PolygonMesh read_body(Source source, const PlyHeader& header, const std::string& file)
{
    PolygonMesh mesh;
    for (const PlyElement& element : header.elements) {
        check_count(element, header.encoding, source.remaining(), file);
        if (element.name == "vertex")
            read_vertices(source, element, file, mesh);
        else if (element.name == "face")
            read_faces(source, element, file, mesh);
        else
            skip_elements(source, element);
    }
    source.check_end();
    return mesh;
}

bool has_element(const PlyHeader& header, std::string_view name)
{
    return std::any_of(header.elements.begin(), header.elements.end(),
                       [&](const PlyElement& element) { return element.name == name; });
}
} // namespace

bool is_ply(std::string_view bytes)
{
    return bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n");
}

PolygonMesh parse_ply(std::string_view bytes, const std::string& file)
{
    const PlyHeader header = parse_ply_header(bytes, file);
    if (!has_element(header, "vertex")) throw FileError(file, "has no element \"vertex\".");
    if (!has_element(header, "face")) throw FileError(file, "has no element \"face\" (only faces can be rendered).");
    if (header.encoding == PlyEncoding::text) return read_body(TextSource(header, file), header, file);
    return read_body(BinarySource(bytes, header, file), header, file);
}
} // namespace etendue
