// The shapes of a scene in world space, double precision: what Geometry is made from.
#pragma once

#include "geometry/geometry.h"
#include "geometry/mesh.h"

namespace etendue
{
struct PlacedMesh {
    Mesh mesh;
    std::uint32_t shape = 0; // index into Scene::shapes
};
struct PlacedSphere {
    Vec3 centre{0.0};
    double radius = 0.0;
    std::uint32_t shape = 0;
};
struct PlacedDisk {
    Vec3 centre{0.0};
    Vec3 normal{0.0}; // unit
    double radius = 0.0;
    std::uint32_t shape = 0;
};

struct PlacedShapes {
    std::vector<PlacedMesh> meshes;
    std::vector<PlacedSphere> spheres;
    std::vector<PlacedDisk> disks;

    std::uint64_t triangle_count() const;
    // Of what triangles use, spheres and disks.
    Bounds bounds() const;
};

// Read and place the shapes of a scene, in its order. Fills the statistics of meshes and appends warnings. Throws
// FileError (unreadable mesh) and SceneError (a sphere or disk whose transform is no similarity or whose size is not
// positive and finite; an index of inline triangles that is out of range).
PlacedShapes place_shapes(const Scene& scene, const GeometryOptions& options, GeometryStatistics& statistics,
                          std::vector<std::string>& warnings);

// What no ray can meet is an error, or with lenient dropped and counted. First the triangles with corners that are not
// finite; then, in coordinates rounded to float after this normalisation, those without area. Return how many were
// dropped. Throw SceneError naming shape, mesh file and triangle.
std::uint64_t drop_non_finite(PlacedShapes& shapes, const Scene& scene, bool lenient);
std::uint64_t drop_flat(PlacedShapes& shapes, const Scene& scene, bool lenient, const Normalisation& normalisation);

// (point - centre) * scale, in double.
Vec3 normalised(const Vec3& point, const Normalisation& normalisation);
// The same, rounded to float.
Vec3 rounded(const Vec3& point, const Normalisation& normalisation);
} // namespace etendue
