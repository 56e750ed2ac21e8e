// Small scenes made in code, and their pictures by the way every render goes: Scene, Geometry, Renderer, Film.
#pragma once

#include "compute/device.h"
#include "render/film.h"
#include "render/renderer.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace etendue
{
struct PictureOptions {
    // The general kernel serves every scene, so that a device compiles it once for all tests.
    bool specialize = false;
    std::uint32_t lanes = 0; // 0: as suits the device
    LaunchShape shape;
    std::optional<PixelRect> crop;
};

// What the film holds at the end, row by row from the top left pixel of the crop.
struct Picture {
    int width = 0, height = 0;
    std::vector<PixelEstimate> pixels;
    RenderReport report;

    const PixelEstimate& at(int x, int y) const { return pixels.at(static_cast<std::size_t>(y * width + x)); }
};

// Render a scene with its own film, integrator, seed and samples per pixel. Checks that every sample is there and that
// no health counter moved.
Picture render_picture(const Device& device, const Scene& scene, const PictureOptions& options = {});

// A scene whose integrator is the given one, without roulette and without anything in it.
Scene empty_scene(IntegratorType integrator, std::optional<std::uint32_t> max_depth);

using ShapeGeometry = decltype(ShapeDescription::geometry);

// Parameters are those of the material's table; returns the material's index.
std::uint32_t add_material(Scene& scene, BsdfType bsdf, std::vector<double> parameters);
std::uint32_t add_diffuse(Scene& scene, const Vec3& albedo);
ShapeDescription& add_shape(Scene& scene, ShapeGeometry geometry, std::uint32_t material,
                            const Mat4& transform = Mat4(1.0));
// A black one-sided light.
ShapeDescription& add_light(Scene& scene, ShapeGeometry geometry, const Vec3& radiance,
                            const Mat4& transform = Mat4(1.0));

// Moves the origin to a place; the second and third turn +z, the normal of rectangles and disks, to +y and -y before.
Mat4 moved_to(const Vec3& place);
Mat4 facing_up(const Vec3& place = Vec3(0.0));
Mat4 facing_down(const Vec3& place);

// A camera of width x height pixels and a vertical angle in degrees.
void look(Scene& scene, const Vec3& from, const Vec3& at, double vertical_fov, int width, int height);
// A camera whose every pixel is the same ray: each sample of the picture is one of the same random variable.
void look_at_point(Scene& scene, const Vec3& from, const Vec3& at, int width, int height);

// A square floor in the plane y = 0 around the origin, of albedo FLOOR_ALBEDO, whose every sample is the light that the
// origin sends to the camera; 128 x 128 pixels. Lights are still to come.
inline const Vec3 FLOOR_ALBEDO{0.6, 0.4, 0.2};
Scene floor_seen_at_origin(IntegratorType integrator, double size, const Vec3& camera, std::uint64_t samples_per_pixel);

// A polyhedron of 8 n^2 triangles inscribed in the unit sphere, normals outward.
InlineTriangles octasphere(int n);
} // namespace etendue
