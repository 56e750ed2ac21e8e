// From polygons to triangles in world space.
#include "geometry/mesh.h"

#include "math/shared.h"
#include "math/transform.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace etendue
{
namespace
{
[[noreturn]] void throw_face_error(const PolygonMesh& mesh, const std::string& file, std::size_t face,
                                   const std::string& message)
{
    const std::string place = mesh.lines.empty() ? file : fmt::format("{}:{}", file, mesh.lines[face]);
    throw FileError(place, fmt::format("face {} {}", face + mesh.first_index, message));
}

void check_indices(const PolygonMesh& mesh, const std::string& file)
{
    const auto check = [&](const std::vector<std::uint32_t>& corners, std::size_t count, const char* what) {
        std::size_t at = 0;
        for (std::size_t face = 0; face < mesh.sizes.size(); ++face)
            for (std::uint32_t i = 0; i < mesh.sizes[face]; ++i, ++at)
                if (corners[at] >= count && !(corners[at] == NO_INDEX && &corners == &mesh.normal_corners))
                    throw_face_error(mesh, file, face,
                                     fmt::format("uses {} {}, but the file has {}, numbered from {}.", what,
                                                 std::uint64_t{corners[at]} + mesh.first_index, count,
                                                 mesh.first_index));
    };
    check(mesh.corners, mesh.positions.size(), "vertex");
    if (!mesh.normal_corners.empty()) check(mesh.normal_corners, mesh.normals.size(), "normal");
}

void check(const PolygonMesh& mesh, const std::string& file, bool lenient)
{
    if (mesh.sizes.empty()) throw FileError(file, "has no faces.");
    for (std::size_t face = 0; face < mesh.sizes.size(); ++face)
        if (mesh.sizes[face] < 3)
            throw_face_error(mesh, file, face,
                             fmt::format("has {} corners; a face needs at least three.", mesh.sizes[face]));
    check_indices(mesh, file);
    for (std::size_t i = 0; i < mesh.positions.size() && !lenient; ++i)
        if (const Vec3& p = mesh.positions[i]; !is_finite(p))
            throw FileError(file, fmt::format("vertex {} is at ({}, {}, {}), which is not finite.",
                                              i + mesh.first_index, p.x, p.y, p.z));
}

// Twice the area of a polygon times its normal (Newell).
Vec3 area_vector(const std::vector<Vec3>& positions, std::span<const std::uint32_t> face)
{
    Vec3 sum(0.0);
    const Vec3 origin = positions[face[0]];
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
        sum += glm::cross(positions[face[i]] - origin, positions[face[i + 1]] - origin);
    return sum;
}

// Whether every triangle of the fan of corner `apex` faces the way the polygon does.
bool is_fan(const std::vector<Vec3>& positions, std::span<const std::uint32_t> face, std::size_t apex, const Vec3& area)
{
    const std::size_t n = face.size();
    const Vec3 origin = positions[face[apex]];
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const Vec3 b = positions[face[(apex + i) % n]] - origin;
        const Vec3 c = positions[face[(apex + i + 1) % n]] - origin;
        if (!(glm::dot(glm::cross(b, c), area) > 0.0)) return false;
    }
    return true;
}

// The corner from which to cut a face, or its size where no corner sees the whole of it. So many corners are tried that
// a polygon with a million corners takes no million squared.
std::size_t find_apex(const std::vector<Vec3>& positions, std::span<const std::uint32_t> face)
{
    constexpr std::size_t MOST_TRIED = 64;
    const Vec3 area = area_vector(positions, face);
    for (std::size_t apex = 0; apex < std::min(face.size(), MOST_TRIED); ++apex)
        if (is_fan(positions, face, apex, area)) return apex;
    return face.size();
}

void append_fan(std::vector<glm::u32vec3>& triangles, std::span<const std::uint32_t> face, std::size_t apex)
{
    const std::size_t n = face.size();
    for (std::size_t i = 1; i + 1 < n; ++i)
        triangles.emplace_back(face[apex], face[(apex + i) % n], face[(apex + i + 1) % n]);
}
} // namespace

glm::u32vec3 Mesh::normals_of(std::size_t triangle) const
{
    if (normals.empty()) return glm::u32vec3(NO_INDEX);
    return normal_indices.empty() ? indices[triangle] : normal_indices[triangle];
}

Mesh triangulate(PolygonMesh&& polygons, const std::string& file, bool lenient)
{
    check(polygons, file, lenient);
    Mesh mesh;
    mesh.positions = std::move(polygons.positions);
    mesh.normals = std::move(polygons.normals);
    mesh.warnings = std::move(polygons.warnings);
    const bool own_normals = !mesh.normals.empty() && !polygons.normal_corners.empty();
    const std::size_t count = polygons.corners.size() - 2 * polygons.sizes.size();
    mesh.indices.reserve(count);
    if (own_normals) mesh.normal_indices.reserve(count);

    const std::span<const std::uint32_t> corners(polygons.corners);
    const std::span<const std::uint32_t> normal_corners(polygons.normal_corners);
    std::size_t at = 0, not_fans = 0;
    for (const std::uint32_t size : polygons.sizes) {
        const auto face = corners.subspan(at, size);
        std::size_t apex = size == 3 ? 0 : find_apex(mesh.positions, face);
        if (apex == size) ++not_fans, apex = 0;
        append_fan(mesh.indices, face, apex);
        if (own_normals) append_fan(mesh.normal_indices, normal_corners.subspan(at, size), apex);
        at += size;
    }
    if (not_fans > 0)
        mesh.warnings.push_back(fmt::format("{}: {} faces with more than three corners are seen whole from none of "
                                            "their corners; cut them into triangles before exporting.",
                                            file, not_fans));
    return mesh;
}

void transform_mesh(Mesh& mesh, const Mat4& matrix)
{
    for (Vec3& position : mesh.positions) position = transform_point(matrix, position);
    for (Vec3& normal : mesh.normals) normal = unit_or_zero(transform_normal(matrix, unit_or_zero(normal)));
    if (!mirrors(matrix)) return;
    for (glm::u32vec3& triangle : mesh.indices) std::swap(triangle.y, triangle.z);
    for (glm::u32vec3& triangle : mesh.normal_indices) std::swap(triangle.y, triangle.z);
}
} // namespace etendue
