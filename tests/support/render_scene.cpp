// From a scene in code to its picture.
#include "support/render_scene.h"

#include "geometry/geometry.h"
#include "render/render_settings.h"
#include "support/child_process.h"

#include <catch2/catch.hpp>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

namespace etendue
{
namespace
{
// Compiled kernels of this run. Programs outlive what is released at its end: drivers are unloaded in an order of their
// own.
const KernelCache& run_cache()
{
    static const TemporaryFolder folder;
    static const KernelCache& cache = *new KernelCache(KernelCache::at(folder.path()).remembering());
    return cache;
}

void check_health(const RenderReport& report)
{
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) {
        INFO("health counter " << health_name(kind));
        CHECK(report.health[kind].count == 0);
    }
}
} // namespace

Picture render_picture(const Device& device, const Scene& scene, const PictureOptions& options)
{
    const Geometry geometry = make_geometry(scene);
    RenderOptions render_options;
    render_options.devices = {device.info()};
    render_options.lanes = options.lanes;
    render_options.specialize = options.specialize;
    render_options.cache = run_cache();
    render_options.shape = options.shape;
    Renderer renderer(scene, geometry, false, render_options);

    const PixelRect crop = options.crop.value_or(PixelRect{0, 0, scene.film.width, scene.film.height});
    Film film(scene.film.width, scene.film.height, crop, false);
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    renderer.render(film, limits);
    renderer.store_in_cache();
    check_health(renderer.report());
    CHECK(film.min_samples() == limits.samples_per_pixel);

    Picture picture{crop.width, crop.height, {}, renderer.report()};
    for (int y = crop.y; y < crop.y + crop.height; ++y)
        for (int x = crop.x; x < crop.x + crop.width; ++x) picture.pixels.push_back(film.estimate(x, y));
    return picture;
}

Scene empty_scene(IntegratorType integrator, std::optional<std::uint32_t> max_depth)
{
    Scene scene;
    scene.integrator.type = integrator;
    scene.integrator.max_depth = max_depth;
    scene.integrator.roulette = RouletteType::off;
    return scene;
}

std::uint32_t add_material(Scene& scene, BsdfType bsdf, std::vector<double> parameters)
{
    scene.materials.push_back({"material", bsdf, std::move(parameters), {}});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t add_diffuse(Scene& scene, const Vec3& albedo)
{
    return add_material(scene, BSDF_DIFFUSE, {albedo.x, albedo.y, albedo.z});
}

ShapeDescription& add_shape(Scene& scene, ShapeGeometry geometry, std::uint32_t material, const Mat4& transform)
{
    ShapeDescription& shape = scene.shapes.emplace_back();
    shape.geometry = std::move(geometry);
    shape.material = material;
    shape.transform = transform;
    return shape;
}

ShapeDescription& add_light(Scene& scene, ShapeGeometry geometry, const Vec3& radiance, const Mat4& transform)
{
    ShapeDescription& light = add_shape(scene, std::move(geometry), add_diffuse(scene, Vec3(0.0)), transform);
    light.emission = Emission{radiance, false};
    return light;
}

Mat4 moved_to(const Vec3& place)
{
    return glm::translate(Mat4(1.0), place);
}

Mat4 facing_up(const Vec3& place)
{
    return glm::rotate(moved_to(place), -glm::half_pi<double>(), Vec3(1, 0, 0));
}

Mat4 facing_down(const Vec3& place)
{
    return glm::rotate(moved_to(place), glm::half_pi<double>(), Vec3(1, 0, 0));
}

void look(Scene& scene, const Vec3& from, const Vec3& at, double vertical_fov, int width, int height)
{
    scene.camera.position = from;
    scene.camera.look_at = at;
    scene.camera.vertical_fov = vertical_fov;
    scene.film.width = width;
    scene.film.height = height;
}

void look_at_point(Scene& scene, const Vec3& from, const Vec3& at, int width, int height)
{
    look(scene, from, at, 1e-7, width, height);
}

Scene floor_seen_at_origin(IntegratorType integrator, double size, const Vec3& camera, std::uint64_t samples_per_pixel)
{
    Scene scene = empty_scene(integrator, 4);
    add_shape(scene, RectangleShape{Vec2(size)}, add_diffuse(scene, FLOOR_ALBEDO), facing_up());
    look_at_point(scene, camera, Vec3(0.0), 128, 128);
    scene.sampler.samples_per_pixel = samples_per_pixel;
    return scene;
}

InlineTriangles octasphere(int n)
{
    InlineTriangles mesh;
    // Corners (i, j, n - i - j) / n of each octant, pushed onto the sphere.
    const auto add = [&](const Vec3& octant, int i, int j) {
        mesh.positions.push_back(glm::normalize(octant * Vec3(i, j, n - i - j)));
    };
    for (int signs = 0; signs < 8; ++signs) {
        const Vec3 octant(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1);
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                add(octant, i, j), add(octant, i + 1, j), add(octant, i, j + 1);
                if (i + j + 1 < n) add(octant, i + 1, j), add(octant, i + 1, j + 1), add(octant, i, j + 1);
            }
    }
    for (glm::uint i = 0; i < mesh.positions.size(); i += 3) {
        const auto& p = mesh.positions;
        const bool outward = glm::dot(glm::cross(p[i + 1] - p[i], p[i + 2] - p[i]), p[i]) > 0.0;
        mesh.indices.push_back(outward ? glm::u32vec3(i, i + 1, i + 2) : glm::u32vec3(i, i + 2, i + 1));
    }
    return mesh;
}
} // namespace etendue
