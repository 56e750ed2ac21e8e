// All integrators but the picture of normals converge to one picture, which an independent tracer also finds; what a
// depth limit means; and the exact colours of normals.
#include "support/device_evaluate.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace etendue;

namespace
{
constexpr IntegratorType INTEGRATORS[] = {IntegratorType::hemisphere, IntegratorType::bsdf, IntegratorType::light,
                                          IntegratorType::path};

// Diffuse, mirror and glass, every kind of shape and light, and a sky.
Scene small_room(IntegratorType integrator, std::uint32_t max_depth)
{
    Scene scene = empty_scene(integrator, max_depth);
    scene.integrator.roulette = RouletteType::throughput;
    const std::uint32_t grey = add_diffuse(scene, {0.7, 0.65, 0.6}), red = add_diffuse(scene, {0.6, 0.2, 0.1});
    const std::uint32_t mirror = add_material(scene, BSDF_MIRROR, {0.9, 0.9, 0.8});
    const std::uint32_t glass = add_material(scene, BSDF_DIELECTRIC, {1.5, 0.9, 1.0, 0.95});
    add_shape(scene, RectangleShape{Vec2(2.0)}, grey, facing_up());
    add_shape(scene, RectangleShape{Vec2(2.0)}, grey, moved_to({0, 1, -1}));
    add_shape(scene, RectangleShape{Vec2(2.0)}, red,
              glm::rotate(moved_to({-1, 1, 0}), glm::half_pi<double>(), Vec3(0, 1, 0)));
    add_shape(scene, BoxShape{{0.5, 0.8, 0.5}}, grey, glm::rotate(moved_to({-0.4, 0.4, -0.3}), 0.4, Vec3(0, 1, 0)));
    add_shape(scene, SphereShape{0.3}, glass, moved_to({0.4, 0.31, 0.4}));
    add_shape(scene, DiskShape{0.5}, mirror, glm::rotate(moved_to({0.6, 0.8, -0.7}), -0.5, Vec3(0, 1, 0)));
    add_light(scene, RectangleShape{{1.0, 0.8}}, {3, 3, 2}, facing_down({0, 1.9, 0.2}));
    add_light(scene, SphereShape{0.2}, {2, 4, 6}, moved_to({-0.5, 1.1, 0.5}));
    add_light(scene, DiskShape{0.3}, {4, 2, 1}, moved_to({0.8, 1.5, -0.5})).emission->two_sided = true;
    scene.environment = EnvironmentDescription{{0.2, 0.3, 0.4}, {}};
    look(scene, {0.1, 1.0, 4.5}, {0, 0.95, 0}, 26, 32, 32);
    scene.sampler.samples_per_pixel = 512;
    return scene;
}
} // namespace

TEST_CASE("four integrators converge to the picture of an independent tracer", "[render][integrator]")
{
    MeanTests means("small room");
    ReferenceOptions options;
    options.samples_per_batch = 5;
    const Scene scene = small_room(IntegratorType::path, 8);
    const Picture reference = as_picture(scene, render_reference(scene, options), options);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : INTEGRATORS) {
            CAPTURE(static_cast<int>(integrator));
            means.check_same(render_picture(device, small_room(integrator, 8)), reference, 4, 0.025);
        }
}

TEST_CASE("a depth limit ends the integrators where it ends the independent tracer", "[render][integrator]")
{
    MeanTests means("small room of limited depth");
    ReferenceOptions options;
    options.samples_per_batch = 5;
    for (const std::uint32_t depth : {1u, 2u, 3u}) {
        const Scene scene = small_room(IntegratorType::path, depth);
        const Picture reference = as_picture(scene, render_reference(scene, options), options);
        for (const Device& device : test_devices())
            for (const IntegratorType integrator :
                 {IntegratorType::bsdf, IntegratorType::light, IntegratorType::path}) {
                CAPTURE(depth, static_cast<int>(integrator));
                means.check_same(render_picture(device, small_room(integrator, depth)), reference, 4, 0.025);
            }
    }
}

TEST_CASE("depth 0 is emission, depth 1 direct light, depth 2 the first bounce", "[render][integrator]")
{
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : INTEGRATORS) {
            CAPTURE(static_cast<int>(integrator));
            // The lamp shines at the wall, and the floor's point is behind it.
            Scene scene = floor_seen_at_origin(integrator, 2.0, {0.8, 0.3, 0.6}, 1);
            add_shape(scene, RectangleShape{Vec2(2.0)}, add_diffuse(scene, Vec3(0.8)), moved_to({0, 1, -1}));
            add_light(scene, RectangleShape{Vec2(1.0)}, {1, 2, 3}, moved_to({0, 0.6, -0.2})).flip_normals = true;
            const auto with_depth = [&](std::uint32_t depth) {
                scene.integrator.max_depth = depth;
                return render_picture(device, scene);
            };
            check_every_pixel(with_depth(0), Vec3(0.0), 0.0);
            check_every_pixel(with_depth(1), Vec3(0.0), 0.0);
            CHECK(estimate_of(with_depth(2), 0).mean > 0.001);
            // The wall below the lamp is lit at once.
            look_at_point(scene, {0.8, 0.05, 0.6}, {0, 0.05, -1}, 64, 64);
            check_every_pixel(with_depth(0), Vec3(0.0), 0.0);
            CHECK(estimate_of(with_depth(1), 0).mean > 0.01);
            // The lamp itself is seen at every depth.
            look_at_point(scene, {0.4, 0.3, -0.9}, {0, 0.6, -0.2}, 8, 8);
            for (const std::uint32_t depth : {0u, 1u, 5u}) check_every_pixel(with_depth(depth), {1, 2, 3}, 0.0);
        }
}

TEST_CASE("the picture of normals has their exact colours", "[render][integrator]")
{
    Scene scene = empty_scene(IntegratorType::normals, 1);
    const std::uint32_t grey = add_diffuse(scene, Vec3(0.5));
    scene.environment = EnvironmentDescription{Vec3(1.0), {}};
    for (const Device& device : test_devices()) {
        const auto colour_at = [&](int width) { return render_picture(device, scene).at(width / 2, width / 2).mean; };
        scene.shapes.clear();
        // Each side of a box: (n + 1) / 2.
        add_shape(scene, BoxShape{Vec3(1.0)}, grey);
        for (const Vec3& n :
             {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
            look(scene, 3.0 * n + Vec3(0.2, 0.3, 0.1), Vec3(0.0), 20, 3, 3);
            CHECK(colour_at(3) == 0.5 * n + 0.5);
        }
        // Nothing is black.
        look(scene, {0, 0, 3}, {0, 0, 5}, 20, 3, 3);
        CHECK(colour_at(3) == Vec3(0.0));
        // A sphere where the pixel's ray meets it.
        scene.shapes.clear();
        add_shape(scene, SphereShape{1.0}, grey);
        look(scene, {0, 0, 4}, {0.3, 0.2, 0}, 20, 1, 1);
        const Vec3 origin(0, 0, 4), direction = glm::normalize(Vec3(0.3, 0.2, -4));
        const double middle = -glm::dot(origin, direction);
        const double half_chord = std::sqrt(middle * middle - glm::dot(origin, origin) + 1.0);
        const Vec3 expected = 0.5 * (origin + (middle - half_chord) * direction) + 0.5;
        CHECK(glm::length(colour_at(1) - expected) < 1e-6);
    }
}
