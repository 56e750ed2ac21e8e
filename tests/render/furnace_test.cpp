// Rooms whose walls all glow alike, and convex bodies under a uniform sky: every path brings the same sum, so pictures
// are exact to rounding. With radiance 1, albedo a and D scatterings the sum is 1 + a + ... + a^D.
#include "support/device_evaluate.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

using namespace etendue;

namespace
{
// The room's shape has normals outward; the walls emit inward. Seen by a camera of 16 x 16 pixels off the centre.
Scene furnace(ShapeGeometry walls, const Vec3& albedo, IntegratorType integrator, std::uint32_t max_depth,
              const Mat4& transform = Mat4(1.0))
{
    Scene scene = empty_scene(integrator, max_depth);
    ShapeDescription& shape = add_shape(scene, std::move(walls), add_diffuse(scene, albedo), transform);
    shape.flip_normals = true;
    shape.emission = Emission{Vec3(1.0), false};
    const auto place = [&](const Vec3& p) { return Vec3(transform * Vec4(p, 1.0)); };
    look(scene, place({0.1, 0.2, -0.3}), place({0.5, -0.1, 0.4}), 100, 16, 16);
    scene.sampler.samples_per_pixel = 4;
    return scene;
}

// Albedo as the device has it.
Vec3 as_float(const Vec3& albedo)
{
    return Vec3(glm::vec3(albedo));
}

// 1 + a + ... + a^depth
Vec3 furnace_radiance(const Vec3& albedo, std::uint32_t depth)
{
    Vec3 sum(0.0), power(1.0);
    for (std::uint32_t k = 0; k <= depth; ++k, power *= as_float(albedo)) sum += power;
    return sum;
}

// Each of the D multiplications and D additions of a path rounds once.
double furnace_roundings(std::uint32_t depth)
{
    return 2.0 * depth + 4.0;
}

const ShapeGeometry ROOM = BoxShape{Vec3(2.0)};
} // namespace

TEST_CASE("every path in a box that glows brings the exact sum of its depth", "[render][furnace]")
{
    for (const Device& device : test_devices())
        for (const Vec3& albedo : {Vec3(0.5, 0.8, 0.99), Vec3(0.9999, 0.0, 0.8)})
            for (const std::uint32_t depth : {0u, 1u, 2u, 8u, 64u, 1000u}) {
                INFO("depth " << depth);
                Scene scene = furnace(ROOM, albedo, IntegratorType::bsdf, depth);
                check_every_pixel(render_picture(device, scene), furnace_radiance(albedo, depth),
                                  furnace_roundings(depth));
            }
}

TEST_CASE("half a million secondary rays in a box that glows never leave it", "[render][furnace]")
{
    for (const Device& device : test_devices()) {
        Scene scene = furnace(ROOM, Vec3(0.8), IntegratorType::bsdf, 8);
        look(scene, scene.camera.position, scene.camera.look_at, 100, 64, 64);
        scene.sampler.samples_per_pixel = 16;
        for (const bool specialize : {false, true}) {
            PictureOptions how;
            how.specialize = specialize;
            const Picture picture = render_picture(device, scene, how);
            check_every_pixel(picture, Vec3(4.32891136), 1e3); // to the digits of that number
            check_every_pixel(picture, furnace_radiance(Vec3(0.8), 8), furnace_roundings(8));
        }
    }
}

TEST_CASE("white walls add exactly one at every vertex, ten thousand times", "[render][furnace]")
{
    for (const Device& device : test_devices())
        for (const std::uint32_t depth : {0u, 1u, 2u, 8u, 64u, 1000u, 10000u}) {
            INFO("depth " << depth);
            Scene scene = furnace(ROOM, Vec3(1.0), IntegratorType::bsdf, depth);
            look(scene, scene.camera.position, scene.camera.look_at, 100, 8, 8);
            scene.sampler.samples_per_pixel = 1;
            check_every_pixel(render_picture(device, scene), Vec3(depth + 1.0), 0.0);
        }
}

TEST_CASE("a sphere that glows is exact at any size and any distance from the origin", "[render][furnace]")
{
    const Vec3 albedo(0.5, 0.9, 0.99);
    for (const Device& device : test_devices())
        for (const ShapeGeometry& walls : {ShapeGeometry(SphereShape{1.0}), ShapeGeometry(octasphere(4))})
            for (const double radius : {1e-4, 1.0, 1e4})
                for (const double offset : {0.0, 1e5}) {
                    CAPTURE(walls.index(), radius, offset);
                    const Mat4 transform = glm::scale(moved_to(offset * radius * Vec3(1, -1, 1)), Vec3(radius));
                    Scene scene = furnace(walls, albedo, IntegratorType::bsdf, 64, transform);
                    check_every_pixel(render_picture(device, scene), furnace_radiance(albedo, 64),
                                      furnace_roundings(64));
                }
}

TEST_CASE("light sampled by area inside a sphere that glows has no variance", "[render][furnace]")
{
    // Between two points of a sphere cos cos' / r^2 is constant.
    const Vec3 albedo(0.8, 0.5, 0.2);
    for (const Device& device : test_devices()) {
        Scene scene = furnace(SphereShape{1.0}, albedo, IntegratorType::light, 3);
        for (const PixelEstimate& pixel : render_picture(device, scene).pixels)
            for (int i = 0; i < 3; ++i) CHECK(pixel.mean[i] == Approx(furnace_radiance(albedo, 3)[i]).epsilon(1e-4));
    }
}

TEST_CASE("light sampling and its combination with scattering find the furnace's mean", "[render][furnace]")
{
    MeanTests means("furnace with light sampling");
    const Vec3 albedo(0.8, 0.5, 0.2);
    for (const Device& device : test_devices()) {
        // Further vertices come arbitrarily close to edges, where light sampling alone has infinite variance.
        Scene light = furnace(ROOM, albedo, IntegratorType::light, 1);
        look_at_point(light, light.camera.position, {1, 0.2, 0.1}, 128, 128);
        light.sampler.samples_per_pixel = 32;
        means.check(render_picture(device, light), furnace_radiance(albedo, 1));

        Scene path = furnace(ROOM, albedo, IntegratorType::path, 8);
        look(path, path.camera.position, path.camera.look_at, 100, 256, 256);
        path.sampler.samples_per_pixel = 1;
        const Picture picture = render_picture(device, path);
        means.check(picture, furnace_radiance(albedo, 8));
        // With the power heuristic a light sample brings f cos / p_light * p_light^2 / (p_light^2 + p_bsdf^2), at most
        // f cos / (2 p_bsdf) = a / 2, and a BSDF sample at most a.
        const Vec3 bound = 1.0 + 1.5 * (furnace_radiance(albedo, 8) - 1.0);
        for (const PixelEstimate& sample : picture.pixels)
            for (int i = 0; i < 3; ++i)
                if (!(sample.mean[i] <= bound[i] * (1.0 + 1e-6)))
                    FAIL_CHECK(fmt::format("a path brings {}, more than {}", sample.mean[i], bound[i]));
    }
}

TEST_CASE("a convex body under a uniform sky has exactly its albedo", "[render][furnace]")
{
    const Vec3 albedo(0.8, 0.5, 0.25);
    const ShapeGeometry bodies[] = {BoxShape{Vec3(1.2)}, SphereShape{0.9}, octasphere(6), DiskShape{0.9}};
    for (const Device& device : test_devices())
        for (const ShapeGeometry& body : bodies) {
            CAPTURE(body.index());
            Scene scene = empty_scene(IntegratorType::bsdf, 4);
            add_shape(scene, body, add_diffuse(scene, albedo));
            scene.environment = EnvironmentDescription{Vec3(1.0), {}};
            look(scene, {2, 1.5, 3}, {0, 0, 0}, 45, 64, 64);
            scene.sampler.samples_per_pixel = 1;
            // Each sample meets the body or the sky.
            std::size_t on_body = 0;
            for (const PixelEstimate& sample : render_picture(device, scene).pixels) {
                if (sample.mean == Vec3(1.0)) continue;
                ++on_body;
                for (int i = 0; i < 3; ++i)
                    if (!(std::abs(sample.mean[i] - as_float(albedo)[i]) <= 4.0 * UNIT_ROUNDOFF * albedo[i]))
                        FAIL_CHECK(fmt::format("the body brings {}, its albedo is {}", sample.mean[i], albedo[i]));
            }
            CHECK(on_body > 64 * 64 / 10);
            CHECK(on_body < 64 * 64 / 2);
        }
}
