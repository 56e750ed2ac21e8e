// From descriptions to shapes in world space, and the triangles that do not count.
#include "geometry/placed_shapes.h"

#include "geometry/mesh_io.h"
#include "geometry/shapes.h"
#include "math/rounding.h"
#include "math/transform.h"
#include "util/stopwatch.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace etendue
{
namespace
{
// Places one kind of shape each; what all need is here once.
class ShapePlacer
{
public:
    ShapePlacer(const Scene& scene, const GeometryOptions& options, GeometryStatistics& statistics,
                std::vector<std::string>& warnings)
        : scene_(scene), options_(options), statistics_(statistics), warnings_(warnings)
    {
    }

    PlacedShapes place()
    {
        for (shape_ = 0; shape_ < scene_.shapes.size(); ++shape_)
            std::visit([this](const auto& geometry) { place(geometry); }, shape().geometry);
        return std::move(placed_);
    }

private:
    const ShapeDescription& shape() const { return scene_.shapes[shape_]; }

    void place(const MeshFile& mesh_file)
    {
        const Stopwatch stopwatch;
        const std::filesystem::path path = std::filesystem::path(scene_.folder) / mesh_file.file;
        place_mesh(read_mesh(path.string(), {options_.lenient, &statistics_.mesh_bytes}));
        statistics_.mesh_seconds += stopwatch.seconds();
    }

    void place(const InlineTriangles& triangles)
    {
        const std::size_t count = triangles.positions.size();
        for (const glm::u32vec3& triangle : triangles.indices)
            for (int i = 0; i < 3; ++i)
                if (triangle[i] >= count)
                    throw SceneError(shape().location,
                                     fmt::format("triangle {} uses vertex {}, but there are {}, numbered from 0.",
                                                 &triangle - triangles.indices.data(), triangle[i], count));
        if (!triangles.normals.empty() && triangles.normals.size() != count)
            throw SceneError(shape().location,
                             fmt::format("there are {} normals for {} vertices.", triangles.normals.size(), count));
        place_mesh(make_mesh(triangles));
    }

    void place(const RectangleShape& rectangle) { place_mesh(make_mesh(rectangle)); }

    void place(const BoxShape& box) { place_mesh(make_mesh(box)); }

    void place_mesh(Mesh&& mesh)
    {
        transform_mesh(mesh, shape().transform);
        warnings_.insert(warnings_.end(), mesh.warnings.begin(), mesh.warnings.end());
        placed_.meshes.push_back({std::move(mesh), shape_});
    }

    void place(const SphereShape& sphere)
    {
        placed_.spheres.push_back({placed_centre(), placed_radius("sphere", sphere.radius), shape_});
    }

    void place(const DiskShape& disk)
    {
        const Vec3 normal = unit_or_zero(transform_normal(shape().transform, Vec3(0, 0, 1)));
        placed_.disks.push_back({placed_centre(), normal, placed_radius("disk", disk.radius), shape_});
    }

    Vec3 placed_centre() const
    {
        const Vec3 centre = transform_point(shape().transform, Vec3(0.0));
        if (!is_finite(centre)) throw SceneError(shape().location, "the centre of the shape is not finite.");
        return centre;
    }

    double placed_radius(const char* what, double radius) const
    {
        const auto scale = similarity_scale(shape().transform);
        if (!scale)
            throw SceneError(shape().location,
                             fmt::format("the transform of a {} must be made of rotations, translations and the same "
                                         "scale along every axis.",
                                         what));
        const double placed = radius * *scale;
        if (!(placed > 0.0 && std::isfinite(placed)))
            throw SceneError(shape().location, fmt::format("the radius must be positive and finite, is {}.", placed));
        return placed;
    }

    const Scene& scene_;
    const GeometryOptions& options_;
    GeometryStatistics& statistics_;
    std::vector<std::string>& warnings_;
    PlacedShapes placed_;
    std::uint32_t shape_ = 0;
};

std::string describe(const ShapeDescription& shape, std::size_t triangle)
{
    std::string text = fmt::format("triangle {}", triangle);
    if (const auto* mesh = std::get_if<MeshFile>(&shape.geometry)) text += " of the mesh " + mesh->file;
    return text + (shape.name.empty() ? "" : " of shape \"" + shape.name + "\"");
}

// Drop each triangle for which `fault` names a reason (null: none), or throw.
template<class Fault>
std::uint64_t drop_triangles(PlacedShapes& shapes, const Scene& scene, bool lenient, Fault fault)
{
    std::uint64_t dropped = 0;
    for (PlacedMesh& placed : shapes.meshes) {
        Mesh& mesh = placed.mesh;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const glm::u32vec3 t = mesh.indices[i];
            const char* reason = fault(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
            const ShapeDescription& shape = scene.shapes[placed.shape];
            if (reason && !lenient)
                throw SceneError(shape.location,
                                 fmt::format("{} {}; --lenient drops such triangles.", describe(shape, i), reason));
            if (reason) continue;
            mesh.indices[kept] = t;
            if (!mesh.normal_indices.empty()) mesh.normal_indices[kept] = mesh.normal_indices[i];
            ++kept;
        }
        dropped += mesh.indices.size() - kept;
        mesh.indices.resize(kept);
        if (!mesh.normal_indices.empty()) mesh.normal_indices.resize(kept);
    }
    return dropped;
}

Vec3 float_difference(const Vec3& a, const Vec3& b)
{
    return Vec3(glm::vec3(a) - glm::vec3(b));
}
} // namespace

std::uint64_t PlacedShapes::triangle_count() const
{
    std::uint64_t count = 0;
    for (const PlacedMesh& placed : meshes) count += placed.mesh.indices.size();
    return count;
}

Bounds PlacedShapes::bounds() const
{
    Bounds bounds;
    for (const PlacedMesh& placed : meshes)
        for (const glm::u32vec3& t : placed.mesh.indices)
            for (int i = 0; i < 3; ++i) bounds.extend(placed.mesh.positions[t[i]]);
    for (const PlacedSphere& sphere : spheres)
        bounds.extend(Bounds{sphere.centre - sphere.radius, sphere.centre + sphere.radius});
    for (const PlacedDisk& disk : disks) {
        const Vec3 half = disk.radius * glm::sqrt(glm::max(Vec3(0.0), 1.0 - disk.normal * disk.normal));
        bounds.extend(Bounds{disk.centre - half, disk.centre + half});
    }
    return bounds;
}

PlacedShapes place_shapes(const Scene& scene, const GeometryOptions& options, GeometryStatistics& statistics,
                          std::vector<std::string>& warnings)
{
    return ShapePlacer(scene, options, statistics, warnings).place();
}

std::uint64_t drop_non_finite(PlacedShapes& shapes, const Scene& scene, bool lenient)
{
    return drop_triangles(shapes, scene, lenient, [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return is_finite(a) && is_finite(b) && is_finite(c) ? nullptr : "has a corner that is not finite";
    });
}

std::uint64_t drop_flat(PlacedShapes& shapes, const Scene& scene, bool lenient, const Normalisation& normalisation)
{
    return drop_triangles(shapes, scene, lenient, [&](const Vec3& world_a, const Vec3& world_b, const Vec3& world_c) {
        const Vec3 a = rounded(world_a, normalisation);
        const Vec3 b = rounded(world_b, normalisation);
        const Vec3 c = rounded(world_c, normalisation);
        if (a == b || b == c || c == a)
            return "has two corners in the same place (as far as single precision can tell)";
        // Products of floats are exact in double, so that this is zero only where the edges of the device are parallel.
        const glm::vec3 cross(glm::cross(float_difference(b, a), float_difference(c, a)));
        return cross == glm::vec3(0.0f) ? "has no area: its corners lie on one line" : nullptr;
    });
}

Vec3 normalised(const Vec3& point, const Normalisation& normalisation)
{
    return (point - normalisation.centre) * normalisation.scale;
}

Vec3 rounded(const Vec3& point, const Normalisation& normalisation)
{
    const Vec3 p = normalised(point, normalisation);
    return Vec3(rounded_to_float(p.x), rounded_to_float(p.y), rounded_to_float(p.z));
}
} // namespace etendue
