// Normalisation, and the arrays of the device in the order of primitives.
#include "geometry/geometry.h"

#include "geometry/camera.h"
#include "geometry/lights.h"
#include "geometry/placed_shapes.h"
#include "math/transform.h"
#include "scene/material_parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace etendue
{
namespace
{
// Vertex normals so close to the triangle's own change no picture and need no interpolation.
constexpr double FLAT_NORMAL_TOLERANCE = 1e-6;

// The bounding sphere grows by this factor, so that it contains the coordinates after they were rounded to float.
constexpr double SPHERE_PADDING = 1.0 + 4.0 * std::numeric_limits<float>::epsilon();

// Centre and power of two that bring the largest half-extent of a box into (1/2, 1].
Normalisation normalise(const Bounds& bounds, const Scene& scene)
{
    const Vec3 extent = bounds.extent();
    const double half = std::max({extent.x, extent.y, extent.z}) / 2.0;
    int exponent = 0;
    if (std::frexp(half, &exponent) == 0.5) --exponent;
    const double scale = std::ldexp(1.0, -exponent);
    if (!(half > 0.0 && std::isfinite(half) && std::isfinite(scale) && scale > 0.0 && is_finite(bounds.centre())))
        throw SceneError(
            fmt::format("{}: the geometry has an extent of {}, which cannot be rendered.", scene.file, 2.0 * half));
    return {bounds.centre(), scale};
}

// Writes the arrays of a Geometry, primitive by primitive.
class GeometryWriter
{
public:
    GeometryWriter(const Scene& scene, Geometry& geometry)
        : scene_(scene), geometry_(geometry), normalisation_(geometry.normalisation)
    {
    }

    void write(const PlacedShapes& shapes)
    {
        geometry_.primitives.reserve(shapes.triangle_count() + shapes.spheres.size() + shapes.disks.size());
        geometry_.surfaces.reserve(geometry_.primitives.capacity());
        for (const PlacedMesh& placed : shapes.meshes) write_mesh(placed);
        for (const PlacedSphere& sphere : shapes.spheres) write_sphere(sphere);
        for (const PlacedDisk& disk : shapes.disks) write_disk(disk);
        geometry_.triangle_count = static_cast<std::uint32_t>(shapes.triangle_count());
        geometry_.sphere_count = static_cast<std::uint32_t>(shapes.spheres.size());
        geometry_.disk_count = static_cast<std::uint32_t>(shapes.disks.size());
    }

    LightList& lights() { return lights_; }

private:
    void write_mesh(const PlacedMesh& placed)
    {
        std::size_t replaced = 0;
        for (std::size_t i = 0; i < placed.mesh.indices.size(); ++i) replaced += write_triangle(placed, i);
        if (replaced > 0) {
            const ShapeDescription& shape = scene_.shapes[placed.shape];
            const auto* file = std::get_if<MeshFile>(&shape.geometry);
            geometry_.warnings.push_back(
                fmt::format("{}: {} vertex normals have no direction; those of the triangles take their place.",
                            file ? file->file : "shape \"" + shape.name + "\"", replaced));
        }
    }

    // Returns the number of vertex normals that had to be replaced.
    std::size_t write_triangle(const PlacedMesh& placed, std::size_t index)
    {
        const Mesh& mesh = placed.mesh;
        const glm::u32vec3 t = mesh.indices[index];
        const std::array<Vec3, 3> world = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        const Vec3 a = rounded(world[0], normalisation_);
        const Vec3 b = rounded(world[1], normalisation_);
        const Vec3 c = rounded(world[2], normalisation_);
        write_primitive(a, b, c, PRIMITIVE_TRIANGLE);

        const Vec3 edge_1 = normalised(world[1], normalisation_) - normalised(world[0], normalisation_);
        const Vec3 edge_2 = normalised(world[2], normalisation_) - normalised(world[0], normalisation_);
        PrimitiveSurface& surface = write_surface(placed.shape, glm::length(glm::cross(edge_1, edge_2)) / 2.0);
        const glm::u32vec3 n = mesh.normals_of(index);
        if (n.x == NO_INDEX) return 0;
        return write_normals(surface, unit_or_zero(glm::cross(b - a, c - a)),
                             {mesh.normals[n.x], mesh.normals[n.y], mesh.normals[n.z]});
    }

    // Orient a triangle by its vertex normals, and store these unless they are the triangle's own.
    std::size_t write_normals(PrimitiveSurface& surface, Vec3 geometric, std::array<Vec3, 3> normals)
    {
        // Turn the geometric normal to the side of the vertex normals.
        if (glm::dot(geometric, normals[0] + normals[1] + normals[2]) < 0.0) {
            surface.flags ^= SURFACE_FLIP_NORMAL;
            geometric = -geometric;
        }
        std::size_t replaced = 0;
        bool flat = true;
        for (Vec3& normal : normals) {
            if (normal == Vec3(0.0)) ++replaced, normal = geometric;
            flat = flat && glm::length(normal - geometric) <= FLAT_NORMAL_TOLERANCE;
        }
        if (flat) return replaced;
        surface.normal = static_cast<uint>(geometry_.normals.size());
        const double sign = turned_round_ ? -1.0 : 1.0;
        for (const Vec3& normal : normals)
            geometry_.normals.push_back(make_real4(sign * normal.x, sign * normal.y, sign * normal.z));
        return replaced;
    }

    void write_sphere(const PlacedSphere& sphere)
    {
        const double radius = checked_radius(sphere.radius, sphere.shape);
        write_primitive(rounded(sphere.centre, normalisation_), Vec3(radius, 0, 0), Vec3(0.0), PRIMITIVE_SPHERE);
        write_surface(sphere.shape, 4.0 * std::numbers::pi * radius * radius);
    }

    void write_disk(const PlacedDisk& disk)
    {
        const double radius = checked_radius(disk.radius, disk.shape);
        write_primitive(rounded(disk.centre, normalisation_), disk.normal, Vec3(radius, 0, 0), PRIMITIVE_DISK);
        write_surface(disk.shape, std::numbers::pi * radius * radius);
    }

    double checked_radius(double radius, std::uint32_t shape) const
    {
        const double scaled = radius * normalisation_.scale;
        if (!(static_cast<real>(scaled) >= std::numeric_limits<real>::min()))
            throw SceneError(scene_.shapes[shape].location,
                             fmt::format("a radius of {} is too small beside the rest of the scene.", radius));
        return scaled;
    }

    void write_primitive(const Vec3& a, const Vec3& b, const Vec3& c, int kind)
    {
        geometry_.primitives.push_back(
            {make_real4(a.x, a.y, a.z, kind), make_real4(b.x, b.y, b.z), make_real4(c.x, c.y, c.z)});
    }

    PrimitiveSurface& write_surface(std::uint32_t shape_index, double area)
    {
        const ShapeDescription& shape = scene_.shapes[shape_index];
        const auto primitive = static_cast<std::uint32_t>(geometry_.surfaces.size());
        const uint light =
            shape.emission ? add_area_light(lights_, *shape.emission, primitive, area, shape.location) : NO_INDEX;
        turned_round_ = shape.flip_normals;
        geometry_.surfaces.push_back({shape.material, light, NO_INDEX, turned_round_ ? SURFACE_FLIP_NORMAL : 0});
        return geometry_.surfaces.back();
    }

    const Scene& scene_;
    Geometry& geometry_;
    const Normalisation normalisation_;
    LightList lights_;
    bool turned_round_ = false; // flip_normals of the shape being written
};

void write_materials(const Scene& scene, Geometry& geometry)
{
    for (const MaterialDescription& material : scene.materials) {
        const uint flags = bsdf_is_delta(material.bsdf) ? MATERIAL_DELTA : 0;
        geometry.materials.push_back(
            {static_cast<uint>(material.bsdf), flags, static_cast<uint>(geometry.parameters.size()), 0});
        for (const double parameter : material.parameters) {
            if (!std::isfinite(static_cast<real>(parameter)))
                throw SceneError(material.location,
                                 fmt::format("a parameter is {}, which is no finite float.", parameter));
            geometry.parameters.push_back(static_cast<real>(parameter));
        }
    }
}

real4 bounding_sphere(const Bounds& bounds, const Normalisation& normalisation)
{
    const Vec3 centre = normalised(bounds.centre(), normalisation);
    const double radius = glm::length(bounds.extent() * normalisation.scale) / 2.0 * SPHERE_PADDING;
    return make_real4(centre.x, centre.y, centre.z, radius);
}

// Choose the normalisation and drop the triangles that no ray can meet; what is dropped does not count for it.
Bounds fit(PlacedShapes& shapes, const Scene& scene, bool lenient, Geometry& geometry)
{
    std::uint64_t dropped = drop_non_finite(shapes, scene, lenient);
    Bounds bounds;
    for (std::uint64_t last = 1; last > 0; dropped += last) {
        bounds = shapes.bounds();
        geometry.normalisation = bounds.empty() ? Normalisation{scene.camera.position, 1.0} : normalise(bounds, scene);
        last = drop_flat(shapes, scene, lenient, geometry.normalisation);
    }
    geometry.statistics.dropped_triangles = dropped;
    if (dropped > 0)
        geometry.warnings.push_back(
            fmt::format("{} triangles without area or with corners that are not finite were dropped.", dropped));
    return bounds;
}

void check_not_empty(const PlacedShapes& shapes, const Scene& scene)
{
    const std::uint64_t count = shapes.triangle_count() + shapes.spheres.size() + shapes.disks.size();
    if (count == 0 && !scene.environment)
        throw SceneError(scene.file + ": the scene has no geometry and no environment: there is nothing to render.");
    if (count >= LEAF_BIT)
        throw SceneError(fmt::format("{}: the scene has {} primitives; at most {} can be told apart.", scene.file,
                                     count, LEAF_BIT - 1));
}
} // namespace

Geometry make_geometry(const Scene& scene, const GeometryOptions& options)
{
    Geometry geometry;
    PlacedShapes shapes = place_shapes(scene, options, geometry.statistics, geometry.warnings);
    const Bounds bounds = fit(shapes, scene, options.lenient, geometry);
    check_not_empty(shapes, scene);
    if (!bounds.empty()) geometry.bounding_sphere = bounding_sphere(bounds, geometry.normalisation);

    GeometryWriter writer(scene, geometry);
    writer.write(shapes);
    if (scene.environment)
        add_environment_light(writer.lights(), *scene.environment, static_cast<double>(geometry.bounding_sphere.s[3]));
    geometry.light_table = make_light_table(writer.lights());
    geometry.lights = std::move(writer.lights().lights);
    write_materials(scene, geometry);
    geometry.camera = make_camera(scene.camera, scene.film.width, scene.film.height, geometry.normalisation);
    return geometry;
}
} // namespace etendue
