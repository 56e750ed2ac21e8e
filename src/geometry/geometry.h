// A scene flattened into what a device needs: primitives in normalised coordinates, surfaces, lights, materials.
#pragma once

#include "math/bounds.h"
#include "math/shared.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
// normalised = (world - centre) * scale, computed in double and then rounded to float. scale is a power of two that
// brings the largest half-extent of the geometry into (1/2, 1], so that translating a scene by a representable vector
// or scaling it by a power of two changes no bit.
struct Normalisation {
    Vec3 centre{0.0};
    double scale = 1.0;
};

struct GeometryOptions {
    bool lenient = false; // drop zero-area and non-finite triangles, counted, instead of failing
};

struct GeometryStatistics {
    std::uint64_t dropped_triangles = 0; // zero-area or non-finite; only with lenient
    double mesh_seconds = 0.0;           // reading mesh files
    std::uint64_t mesh_bytes = 0;
};

struct Geometry {
    Normalisation normalisation;
    std::vector<Primitive> primitives; // triangles, then spheres, then disks
    std::uint32_t triangle_count = 0;
    std::uint32_t sphere_count = 0;
    std::uint32_t disk_count = 0;
    std::vector<PrimitiveSurface> surfaces; // by primitive
    std::vector<real4> normals;             // unit shading normals, three per triangle that has them
    std::vector<Material> materials;
    std::vector<real> parameters;
    std::vector<Light> lights; // area lights in primitive order, then the environment
    std::vector<AliasBucket> light_table;
    Camera camera;
    // Of the geometry in normalised coordinates: centre and radius of a sphere around its box.
    real4 bounding_sphere{};
    GeometryStatistics statistics;
    std::vector<std::string> warnings; // complete sentences
};

// Flatten a scene. Reads the mesh files it names. Throws SceneError (bad geometry, naming shape, mesh file and index)
// and FileError (unreadable mesh).
Geometry make_geometry(const Scene& scene, const GeometryOptions& options = {});
} // namespace etendue
