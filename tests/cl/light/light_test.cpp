// Several lights together: each is chosen as often as its table says, and densities include the choice.
#include "check/device_lights.h"
#include "check/primitive_sets.h"
#include "support/device_evaluate.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

namespace etendue
{
namespace
{
// Lights of all kinds around the origin; the one at index 2 has two sides, the last primitive is no light.
LightScene room()
{
    LightScene scene;
    scene.add_area(make_triangle(make_real4(-1, 2, -1), make_real4(2, 2, 0), make_real4(0, 2, 1.5)), {1, 1, 1}, 1);
    scene.add_area(make_triangle(make_real4(1, -2, 0), make_real4(0, -2, 0), make_real4(0, -2, 1)), {2, 0, 0}, 0.25);
    scene.add_area(make_triangle(make_real4(-3, -1, 0), make_real4(-3, 1, 0), make_real4(-3, 0, 1)), {0, 3, 0}, 3,
                   LIGHT_TWO_SIDED);
    scene.add_environment({0, 0, 4}, 0.5);
    scene.add_area(make_sphere(3, 0, 0, 0.5), {5, 0, 0}, 2);
    scene.add_area({make_real4(0, 0, 3, PRIMITIVE_DISK), make_real4(0, 0, -1), make_real4(0.5, 0, 0)}, {0, 6, 0}, 1e-3);
    scene.add_dark(triangle_at(0, 0, -3, 0.5));
    return scene;
}

// The light that a primitive of room() is, and the other way round.
const std::map<uint, std::size_t> LIGHT_OF_PRIMITIVE{{0, 0}, {1, 1}, {2, 2}, {NO_INDEX, 3}, {3, 4}, {4, 5}};
} // namespace

TEST_CASE("each light is chosen as often as its probability says")
{
    constexpr std::size_t SAMPLES = 1 << 20;
    for (const Device& device : test_devices()) {
        const DeviceLights lights(device, room());
        std::vector<double> counts(6);
        for (const auto& s : lights.sample({0, 0, 0}, random_words(SAMPLES, 67)))
            ++counts[LIGHT_OF_PRIMITIVE.at(s.primitive)];
        double statistic = 0;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double expected = lights.probabilities()[i] * SAMPLES;
            CHECK(expected > 100);
            statistic += std::pow(counts[i] - expected, 2) / expected;
        }
        CHECK(chi_square_p_value(statistic, 5) > 1e-6);
    }
}

TEST_CASE("the choice of a light is exact in integers: one bucket entry below the threshold and one at it")
{
    // Two lights of weight 1 and 3: two buckets of probability 1/2, of which one is shared half and half.
    LightScene scene;
    scene.add_area(triangle_at(0, 0, -1, 0.5), {1, 1, 1}, 1);
    scene.add_area(triangle_at(0, 0, 1, 0.5), {1, 1, 1}, 3);
    for (const Device& device : test_devices()) {
        const DeviceLights lights(device, scene);
        CHECK(lights.probabilities() == std::vector<double>{0.25, 0.75});
        std::vector<std::array<uint, 4>> words;
        for (const uint bucket : {0u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
            for (const uint entry : {0u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
                words.push_back({bucket, entry, 1u << 30, 1u << 30});
        const auto samples = lights.sample({0, 0, 0}, words);
        std::vector<uint> chosen;
        for (const auto& s : samples) chosen.push_back(s.primitive);
        CHECK(chosen == std::vector<uint>{0, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    }
}

TEST_CASE("a ray that meets a light finds its radiance, and the density of its samples, choice included")
{
    for (const Device& device : test_devices()) {
        const DeviceLights lights(device, room());
        const auto samples = lights.sample({0, 0, 0}, random_words(1 << 14, 71));
        std::vector<Point> directions;
        for (const auto& s : samples) directions.push_back(s.to_light);
        const auto hits = lights.meet({0, 0, 0}, directions);
        std::size_t compared = 0, wrong = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (hits[i].primitive != samples[i].primitive) continue; // beside the rim, or behind another light
            ++compared;
            wrong += hits[i].radiance != samples[i].radiance || std::abs(hits[i].pdf / samples[i].pdf - 1) > 1e-3;
        }
        CHECK(wrong == 0);
        CHECK(compared > samples.size() * 9 / 10);
    }
}

TEST_CASE("the densities of all lights together integrate to 1 where every light is seen")
{
    constexpr std::size_t DIRECTIONS = 1 << 18;
    std::vector<Point> directions;
    for (std::size_t i = 0; i < DIRECTIONS; ++i) {
        const auto [u, v] = even_point(i);
        const double z = 1 - 2 * v, r = std::sqrt(1 - z * z), turn = 2 * 3.14159265358979323846 * u;
        directions.push_back({r * std::cos(turn), r * std::sin(turn), z});
    }
    for (const Device& device : test_devices()) {
        const DeviceLights lights(device, room());
        double integral = 0, sky = 0;
        for (const DeviceLightHit& hit : lights.meet({0, 0, 0}, directions)) {
            integral += hit.pdf;
            sky += hit.primitive == NO_INDEX;
        }
        integral *= 4 * 3.14159265358979323846 / DIRECTIONS;
        // Where something stands before the environment its samples are blocked.
        const double blocked = lights.probabilities()[3] * (1 - sky / DIRECTIONS);
        CHECK(integral + blocked == Approx(1).epsilon(3e-3));
    }
}

TEST_CASE("a surface that is no light gives no light")
{
    for (const Device& device : test_devices()) {
        const auto hits = DeviceLights(device, room()).meet({0, 0, 0}, {{0, 0, -1}});
        CHECK(hits[0].primitive == 5);
        CHECK(hits[0].radiance == Point{0, 0, 0});
        CHECK(hits[0].pdf == 0);
    }
}

TEST_CASE("lights are sampled and met with the same bits at every number of lanes")
{
    const auto words = random_words(4096, 73);
    std::vector<Point> directions;
    for (std::size_t i = 0; i < 4096; ++i)
        directions.push_back({even_point(i)[0] - 0.5, even_point(i)[1] - 0.5, even_point(i + 7)[0] - 0.5});
    for (const Device& device : test_devices()) {
        const DeviceLights scalar(device, room(), 1);
        const auto samples = scalar.sample({0, 0, 0}, words);
        const auto hits = scalar.meet({0, 0, 0}, directions);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceLights packed(device, room(), lanes);
            std::size_t different = 0;
            const auto more_samples = packed.sample({0, 0, 0}, words);
            for (std::size_t i = 0; i < words.size(); ++i)
                different += more_samples[i].to_light != samples[i].to_light || more_samples[i].pdf != samples[i].pdf ||
                             more_samples[i].wi != samples[i].wi;
            const auto more_hits = packed.meet({0, 0, 0}, directions);
            for (std::size_t i = 0; i < directions.size(); ++i)
                different += more_hits[i].pdf != hits[i].pdf || more_hits[i].radiance != hits[i].radiance;
            CAPTURE(lanes);
            CHECK(different == 0);
        }
    }
}
} // namespace etendue
