// A diffuse floor under lights of every kind: radiance rho L F by each estimator, with the form factor F in closed
// form.
#include "support/device_evaluate.h"
#include "support/form_factors.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;

namespace
{
const Vec3 RADIANCE{3.0, 2.0, 5.0};
constexpr IntegratorType ESTIMATORS[] = {IntegratorType::hemisphere, IntegratorType::bsdf, IntegratorType::light,
                                         IntegratorType::path};

Scene lit_floor(IntegratorType integrator)
{
    return floor_seen_at_origin(integrator, 10.0, {3, 0.2, 0.1}, 128);
}

// Sampling directions finds a light only by chance, so its mean is known less well.
double smallest_bias(IntegratorType integrator)
{
    const bool samples_lights = integrator == IntegratorType::light || integrator == IntegratorType::path;
    return samples_lights ? 0.005 : 0.02;
}

// The unit square around the origin in the plane z = 0, cut into columns x rows rectangles of very unequal size, two
// triangles each.
InlineTriangles cut_square(glm::uint columns, glm::uint rows)
{
    InlineTriangles mesh;
    const auto place = [](glm::uint i, glm::uint n) { return std::pow(double(i) / n, 2.0) - 0.5; };
    for (glm::uint row = 0; row <= rows; ++row)
        for (glm::uint column = 0; column <= columns; ++column)
            mesh.positions.emplace_back(place(column, columns), place(row, rows), 0.0);
    for (glm::uint row = 0; row < rows; ++row)
        for (glm::uint column = 0; column < columns; ++column) {
            const glm::uint a = row * (columns + 1) + column, b = a + columns + 1;
            mesh.indices.emplace_back(a, a + 1, b + 1);
            mesh.indices.emplace_back(a, b + 1, b);
        }
    return mesh;
}
} // namespace

TEST_CASE("four estimators find Lambert's rectangle", "[render][light]")
{
    MeanTests means("rectangle light");
    const double form_factor = parallel_rectangle_form_factor(0.7, 1.3, 0.9);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : ESTIMATORS) {
            CAPTURE(static_cast<int>(integrator));
            Scene scene = lit_floor(integrator);
            add_light(scene, RectangleShape{{0.7, 1.3}}, RADIANCE, facing_down({0.35, 0.9, 0.65}));
            means.check(render_picture(device, scene), FLOOR_ALBEDO * RADIANCE * form_factor,
                        smallest_bias(integrator));
        }
}

TEST_CASE("four estimators find the form factor of a disk", "[render][light]")
{
    MeanTests means("disk light");
    const double form_factor = disk_form_factor(0.6, 0.8, 0.9);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : ESTIMATORS) {
            CAPTURE(static_cast<int>(integrator));
            Scene scene = lit_floor(integrator);
            add_light(scene, DiskShape{0.6}, RADIANCE, facing_down({0, 0.8, 0.9}));
            means.check(render_picture(device, scene), FLOOR_ALBEDO * RADIANCE * form_factor,
                        smallest_bias(integrator));
        }
}

TEST_CASE("four estimators find the form factor of a sphere, above and across the horizon", "[render][light]")
{
    MeanTests means("sphere light");
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : ESTIMATORS)
            for (const double theta : {0.7, 1.2}) {
                CAPTURE(static_cast<int>(integrator), theta);
                Scene scene = lit_floor(integrator);
                add_light(scene, SphereShape{1.0}, RADIANCE,
                          moved_to({0, 1.6 * std::cos(theta), 1.6 * std::sin(theta)}));
                means.check(render_picture(device, scene),
                            FLOOR_ALBEDO * RADIANCE * sphere_form_factor(1.0, 1.6, theta), smallest_bias(integrator));
            }
}

TEST_CASE("four estimators find a rectangle before a sky", "[render][light]")
{
    MeanTests means("rectangle and environment");
    const double form_factor = parallel_rectangle_form_factor(0.7, 1.3, 0.9);
    const Vec3 sky(0.5, 1.0, 0.2);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : ESTIMATORS) {
            CAPTURE(static_cast<int>(integrator));
            Scene scene = lit_floor(integrator);
            add_light(scene, RectangleShape{{0.7, 1.3}}, RADIANCE, facing_down({0.35, 0.9, 0.65}));
            scene.environment = EnvironmentDescription{sky, {}};
            means.check(render_picture(device, scene),
                        FLOOR_ALBEDO * (RADIANCE * form_factor + sky * (1.0 - form_factor)), 0.02);
        }
}

TEST_CASE("a light in each of the four quadrants gives the same light", "[render][light]")
{
    MeanTests means("quadrant lights");
    // 0.1 to 1 along x and 0.1 to 1.3 along z, from rectangles with a corner overhead.
    const auto from_axis = [](double a, double b) { return parallel_rectangle_form_factor(a, b, 0.8); };
    const double form_factor = from_axis(1.0, 1.3) - from_axis(0.1, 1.3) - from_axis(1.0, 0.1) + from_axis(0.1, 0.1);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : ESTIMATORS)
            for (const double x : {-0.55, 0.55})
                for (const double z : {-0.7, 0.7}) {
                    CAPTURE(static_cast<int>(integrator), x, z);
                    Scene scene = lit_floor(integrator);
                    scene.sampler.samples_per_pixel = 96;
                    add_light(scene, RectangleShape{{0.9, 1.2}}, RADIANCE, facing_down({x, 0.8, z}));
                    const Picture picture = render_picture(device, scene);
                    means.check(estimate_of(picture, 0), FLOOR_ALBEDO.x * RADIANCE.x * form_factor,
                                smallest_bias(integrator));
                }
}

TEST_CASE("the light of two unequal lights adds up", "[render][light]")
{
    MeanTests means("two unequal lights");
    const Vec3 bright(80, 40, 20), dim(0.5, 1.0, 2.0);
    const double small =
        2.0 * (parallel_rectangle_form_factor(0.35, 0.05, 1.0) - parallel_rectangle_form_factor(0.25, 0.05, 1.0));
    const double large = parallel_rectangle_form_factor(2.0, 1.0, 1.5);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : {IntegratorType::light, IntegratorType::path}) {
            CAPTURE(static_cast<int>(integrator));
            Scene scene = lit_floor(integrator);
            add_light(scene, RectangleShape{{0.1, 0.1}}, bright, facing_down({0.3, 1, 0}));
            add_light(scene, RectangleShape{{2.0, 1.0}}, dim, facing_down({-1, 1.5, 0.5}));
            means.check(render_picture(device, scene), FLOOR_ALBEDO * (bright * small + dim * large), 0.01);
        }
}

TEST_CASE("a square light cut into 2, 16 and 4096 unequal triangles gives the same light", "[render][light]")
{
    MeanTests means("cut light");
    const double form_factor = 4.0 * parallel_rectangle_form_factor(0.5, 0.5, 1.0);
    for (const Device& device : test_devices())
        for (const IntegratorType integrator : {IntegratorType::light, IntegratorType::path})
            for (const auto& [columns, rows] : {std::pair(1u, 1u), std::pair(4u, 2u), std::pair(64u, 32u)}) {
                CAPTURE(static_cast<int>(integrator), columns);
                Scene scene = lit_floor(integrator);
                scene.accelerator.build = BuildPlace::host;
                scene.sampler.samples_per_pixel = 32;
                add_light(scene, cut_square(columns, rows), RADIANCE, facing_down({0, 1, 0}));
                means.check(estimate_of(render_picture(device, scene), 0), FLOOR_ALBEDO.x * RADIANCE.x * form_factor);
            }
}
