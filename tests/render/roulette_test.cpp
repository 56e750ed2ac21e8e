// Russian roulette in a room whose walls all glow with radiance 1 and reflect a: the mean is 1 / (1 - a) whatever the
// roulette, and the variance is known.
#include "support/device_evaluate.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;

namespace
{
Scene endless_furnace(const Vec3& albedo, RouletteType roulette, std::uint64_t samples_per_pixel)
{
    Scene scene = empty_scene(IntegratorType::bsdf, std::nullopt);
    scene.integrator.roulette = roulette;
    scene.integrator.roulette_start = 0;
    ShapeDescription& room = add_shape(scene, BoxShape{Vec3(2.0)}, add_diffuse(scene, albedo));
    room.flip_normals = true;
    room.emission = Emission{Vec3(1.0), false};
    look(scene, {0.1, 0.2, -0.3}, {0.5, -0.1, 0.4}, 100, 128, 128);
    scene.sampler.samples_per_pixel = samples_per_pixel;
    return scene;
}

double mean_radiance(double albedo)
{
    return 1.0 / (1.0 - static_cast<double>(static_cast<float>(albedo)));
}

// X = 1 + (a / q) X' with probability q, else 1, so E X^2 = (1 + a) / ((1 - a)(1 - a^2 / q)).
double variance_of_constant_roulette(double a, double q)
{
    return (1.0 + a) / ((1.0 - a) * (1.0 - a * a / q)) - 1.0 / ((1.0 - a) * (1.0 - a));
}
} // namespace

TEST_CASE("constant roulette has the furnace's mean and its own variance", "[render][roulette]")
{
    MeanTests means("constant roulette");
    // All have a finite fourth moment, a^4 < q^3, so that the variance itself can be measured.
    const std::pair<Vec3, double> cases[] = {{{0.5, 0.3, 0.7}, 0.8}, {{0.5, 0.3, 0.1}, 0.5}, {{0.8, 0.5, 0.3}, 0.9}};
    for (const Device& device : test_devices())
        for (const auto& [albedo, survival] : cases) {
            Scene scene = endless_furnace(albedo, RouletteType::constant, 64);
            scene.integrator.roulette_probability = survival;
            const Picture picture = render_picture(device, scene);
            for (int i = 0; i < 3; ++i) {
                CAPTURE(albedo[i], survival);
                const Estimate estimate = estimate_of(picture, i);
                means.check(estimate, mean_radiance(albedo[i]), 0.01);
                CHECK(estimate.variance == Approx(variance_of_constant_roulette(albedo[i], survival)).epsilon(0.05));
            }
        }
}

TEST_CASE("roulette by throughput has the furnace's mean and the variance of the number of vertices",
          "[render][roulette]")
{
    MeanTests means("roulette by throughput");
    for (const Device& device : test_devices())
        for (const double albedo : {0.98, 0.5}) {
            CAPTURE(albedo);
            const Scene scene = endless_furnace(Vec3(albedo), RouletteType::throughput, albedo > 0.9 ? 16 : 64);
            const Estimate estimate = estimate_of(render_picture(device, scene), 0);
            means.check(estimate, mean_radiance(albedo), 0.015);
            // A path that survives has throughput 1 again: its length is geometric.
            CHECK(estimate.variance == Approx(albedo / ((1.0 - albedo) * (1.0 - albedo))).epsilon(0.05));
        }
}

TEST_CASE("roulette by throughput keeps every channel's mean, early or late", "[render][roulette]")
{
    MeanTests means("roulette by throughput in colour");
    // The last albedo is below the least probability of survival.
    for (const Device& device : test_devices())
        for (const Vec3& albedo : {Vec3(0.9, 0.5, 0.2), Vec3(0.01, 0.005, 0.0)})
            for (const std::uint32_t start : {0u, 3u}) {
                CAPTURE(albedo.x, start);
                Scene scene = endless_furnace(albedo, RouletteType::throughput, 64);
                scene.integrator.roulette_start = start;
                const Picture picture = render_picture(device, scene);
                for (int i = 0; i < 3; ++i) means.check(estimate_of(picture, i), mean_radiance(albedo[i]), 0.01);
            }
}

TEST_CASE("white walls under roulette by throughput end at the depth limit", "[render][roulette]")
{
    for (const Device& device : test_devices()) {
        Scene scene = endless_furnace(Vec3(1.0), RouletteType::throughput, 1);
        scene.integrator.max_depth = 100;
        check_every_pixel(render_picture(device, scene), Vec3(101.0), 0.0);
    }
}
