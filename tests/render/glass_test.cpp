// Glass and mirrors: what they let through is all there is.
#include "support/device_evaluate.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

using namespace etendue;

namespace
{
constexpr std::uint32_t MOST_VERTICES = 1000;

std::uint32_t add_glass(Scene& scene, double ior, const Vec3& tint = Vec3(1.0))
{
    return add_material(scene, BSDF_DIELECTRIC, {ior, tint.x, tint.y, tint.z});
}

Scene glass_before_sky()
{
    Scene scene = empty_scene(IntegratorType::path, MOST_VERTICES);
    scene.environment = EnvironmentDescription{Vec3(1.0), {}};
    look(scene, {0.3, 0.5, 4}, {0, 0, 0}, 35, 64, 64);
    scene.sampler.samples_per_pixel = 1;
    return scene;
}

// Every sample is 1 but for two roundings at each vertex, or 0 where a path has not found its way out; hardly any.
void check_invisible(const Device& device, const Scene& scene)
{
    const Picture picture = render_picture(device, scene);
    std::size_t lost = 0;
    double worst = 0.0;
    for (const PixelEstimate& sample : picture.pixels) {
        if (sample.mean == Vec3(0.0))
            ++lost;
        else
            for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(sample.mean[i] - 1.0));
    }
    CHECK(worst <= 2.0 * MOST_VERTICES * UNIT_ROUNDOFF);
    CHECK(lost <= picture.pixels.size() / 100);
    // Something was in the way: paths have more vertices than the sky needs.
    CHECK(picture.report.rays() > picture.pixels.size() * 3 / 2);
}

Mat4 tilted()
{
    return glm::rotate(Mat4(1.0), 0.4, glm::normalize(Vec3(1, 2, 3)));
}
} // namespace

TEST_CASE("a body of glass under a uniform sky is invisible for every index", "[render][glass]")
{
    for (const Device& device : test_devices())
        for (const double ior : {1.0, 1.0000001, 1.33, 1.5, 2.4, 1.0 / 1.5, 100.0})
            for (const ShapeGeometry& body : {ShapeGeometry(SphereShape{1.0}), ShapeGeometry(BoxShape{Vec3(1.3)})}) {
                CAPTURE(ior, body.index());
                Scene scene = glass_before_sky();
                add_shape(scene, body, add_glass(scene, ior), tilted());
                check_invisible(device, scene);
            }
}

TEST_CASE("concentric shells of glass under a uniform sky are invisible", "[render][glass]")
{
    for (const Device& device : test_devices())
        for (const double inner_ior : {1.0 / 1.5, 1.7}) {
            CAPTURE(inner_ior);
            Scene scene = glass_before_sky();
            add_shape(scene, SphereShape{1.0}, add_glass(scene, 1.5));
            add_shape(scene, SphereShape{0.8}, add_glass(scene, inner_ior));
            check_invisible(device, scene);
        }
}

TEST_CASE("a slab of glass transmits what Fresnel's law says with all its reflections", "[render][glass]")
{
    MeanTests means("glass slab");
    for (const Device& device : test_devices()) {
        Scene scene = empty_scene(IntegratorType::path, 64);
        add_shape(scene, BoxShape{{4, 4, 1}}, add_glass(scene, 1.5, {1, 0.5, 1}));
        ShapeDescription& light = add_light(scene, DiskShape{1.0}, Vec3(1.0), moved_to({0, 0, -2}));
        look_at_point(scene, {0, 0, 5}, {0, 0, 0}, 128, 128);
        scene.sampler.samples_per_pixel = 32;
        // With t = 0.96 tint and r = 0.04 tint at each surface, t^2 / (1 - r^2): 12/13 without a tint.
        means.check(render_picture(device, scene), {12.0 / 13.0, 0.48 * 0.48 / (1.0 - 0.02 * 0.02), 12.0 / 13.0});
        // A light inside is dimmer by the square of the index, outside its own light is denser.
        light.transform = moved_to({0, 0, 0});
        scene.integrator.max_depth = 1;
        means.check(render_picture(device, scene), Vec3(0.96, 0.48, 0.96) / 2.25);
    }
}

TEST_CASE("a light met after a mirror counts once, whichever way light is sampled", "[render][glass]")
{
    for (const Device& device : test_devices())
        for (const IntegratorType integrator :
             {IntegratorType::hemisphere, IntegratorType::bsdf, IntegratorType::light, IntegratorType::path})
            for (const std::uint32_t depth : {0u, 1u, 5u}) {
                CAPTURE(static_cast<int>(integrator), depth);
                Scene scene = empty_scene(integrator, depth);
                add_shape(scene, RectangleShape{Vec2(10.0)}, add_material(scene, BSDF_MIRROR, {0.9, 0.8, 0.7}),
                          facing_up());
                add_light(scene, RectangleShape{Vec2(1.0)}, Vec3(2.0), facing_down({-3, 2, 0}));
                look_at_point(scene, {3, 2, 0}, {0, 0, 0}, 8, 8);
                scene.sampler.samples_per_pixel = 4;
                check_every_pixel(render_picture(device, scene), depth == 0 ? Vec3(0.0) : Vec3(1.8, 1.6, 1.4), 4.0);
            }
}
