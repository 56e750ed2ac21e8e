// Samplers in pictures: no bias, less noise, an honest error, and the same bits whatever the kernel.
#include "support/device_evaluate.h"
#include "support/form_factors.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"
#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include <fmt/format.h>

using namespace etendue;

namespace
{
constexpr SamplerType SAMPLERS[] = {SamplerType::independent, SamplerType::stratified, SamplerType::sobol};
const Vec3 RADIANCE(10, 20, 5);

// A floor whose every pixel is the light of a rectangle at the origin: 4 * FORM_FACTOR * albedo * RADIANCE.
Scene lit_floor(SamplerType sampler, int size, std::uint64_t samples_per_pixel, std::uint64_t seed)
{
    Scene scene = floor_seen_at_origin(IntegratorType::light, 4.0, {0, 1.5, 2}, samples_per_pixel);
    scene.film.width = scene.film.height = size;
    scene.sampler.type = sampler;
    scene.sampler.seed = seed;
    add_light(scene, RectangleShape{{1.0, 1.4}}, RADIANCE, facing_down({0, 0.8, 0}));
    return scene;
}
double form_factor()
{
    return 4.0 * parallel_rectangle_form_factor(0.5, 0.7, 0.8);
}

// An open box with mirror, glass and two lights, whose paths use every choice that a sampler makes.
Scene full_scene(SamplerType sampler, std::uint32_t replicates)
{
    Scene scene = empty_scene(IntegratorType::path, {});
    scene.integrator.roulette = RouletteType::throughput;
    const std::uint32_t grey = add_diffuse(scene, Vec3(0.7, 0.6, 0.5));
    add_shape(scene, RectangleShape{Vec2(6.0)}, grey, facing_up());
    add_shape(scene, SphereShape{0.5}, add_material(scene, BSDF_DIELECTRIC, {1.5, 1, 1, 1}), moved_to({0.6, 0.7, 0.4}));
    add_shape(scene, RectangleShape{Vec2(2.0)}, add_material(scene, BSDF_MIRROR, {0.9, 0.9, 0.9}),
              moved_to({0, 1, -1.5}));
    add_light(scene, RectangleShape{Vec2(0.5)}, Vec3(20), facing_down({0.3, 2, 0}));
    add_light(scene, SphereShape{0.2}, Vec3(5, 9, 3), moved_to({-1, 1.2, 0.5}));
    look(scene, {0, 1.2, 5}, {0, 0.5, 0}, 35.0, 9, 7);
    scene.film.filter = FilterType::tent;
    scene.film.filter_radius = 1.0;
    scene.sampler = {sampler, 200, 7, replicates, {}};
    return scene;
}

bool same_bits(const Picture& a, const Picture& b)
{
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (a.pixels[i].mean != b.pixels[i].mean || a.pixels[i].standard_error != b.pixels[i].standard_error)
            return false;
    return a.pixels.size() == b.pixels.size();
}

double image_mean(const Picture& picture)
{
    double sum = 0.0;
    for (const PixelEstimate& pixel : picture.pixels) sum += pixel.mean.x;
    return sum / static_cast<double>(picture.pixels.size());
}
} // namespace

TEST_CASE("direct light has no bias with any sampler, and far less noise with Sobol points", "[render][sampler]")
{
    constexpr int SEEDS = 32;
    const double expected = FLOOR_ALBEDO.x * RADIANCE.x * form_factor();
    for (const Device& device : test_devices()) {
        std::vector<double> variances;
        for (const SamplerType sampler : SAMPLERS) {
            RunningStatistics means;
            for (std::uint64_t seed = 0; seed < SEEDS; ++seed)
                means.add(image_mean(render_picture(device, lit_floor(sampler, 8, 256, seed))));
            variances.push_back(means.variance());
            // Student's t over seeds, one of a family of 500 tests at level 1e-3, with a power of 99 %.
            const double critical = student_t_quantile(1.0 - sidak_alpha(1e-3, 500) / 2.0, SEEDS - 1);
            const double smallest = (critical + 2.33) * means.standard_error() / expected;
            std::cout << fmt::format(
                "sampler {}: mean {:.7f} of {:.7f}, variance {:.3g}; a bias of {:.3g} % would have "
                "been seen.\n",
                static_cast<int>(sampler), means.mean(), expected, means.variance(), 100.0 * smallest);
            CAPTURE(static_cast<int>(sampler), means.mean(), expected, means.standard_error());
            CHECK(std::abs(means.mean() - expected) < critical * means.standard_error() + 1e-6 * expected);
            CHECK(smallest < 0.005);
        }
        // F has 31 and 31 degrees of freedom: a ratio below 1/4 is chance once in ten thousand where they are equal.
        CHECK(variances[1] < variances[0] / 4.0);
        CHECK(variances[2] < variances[1] / 4.0);
    }
}

TEST_CASE("the error that a film tells is the one that other seeds show", "[render][sampler]")
{
    // All pixels are the same random variable, drawn independently: their variance is the truth about the error of one.
    constexpr int SIZE = 48;
    for (const Device& device : test_devices())
        for (const SamplerType sampler : SAMPLERS)
            for (const std::uint64_t samples : {256, 320}) {
                const Picture picture = render_picture(device, lit_floor(sampler, SIZE, samples, 5));
                RunningStatistics means, told;
                for (const PixelEstimate& pixel : picture.pixels) {
                    means.add(pixel.mean.x);
                    told.add(std::pow(pixel.standard_error.x, 2.0));
                }
                // Of the variance of n values, for a kurtosis up to 6.
                const double truth = means.variance(), of_truth = truth * std::sqrt(5.0 / (SIZE * SIZE));
                std::cout << fmt::format("sampler {} at {} samples: variance {:.4g} +- {:.1g}, told {:.4g} +- {:.1g}\n",
                                         static_cast<int>(sampler), samples, truth, of_truth, told.mean(),
                                         told.standard_error());
                CAPTURE(static_cast<int>(sampler), samples, truth, told.mean());
                const double allowed = 4.5 * std::hypot(of_truth, told.standard_error());
                CHECK(told.mean() > truth - allowed);
                // Unequal halves tell more than the truth where the error falls faster than with the root of samples.
                if (sampler != SamplerType::sobol || samples % (2 * SAMPLES_PER_BLOCK) == 0)
                    CHECK(told.mean() < truth + allowed);
                CHECK(allowed < 0.4 * truth);
            }
}

TEST_CASE("a single Sobol sequence is at least as good as two, but does not know its error", "[render][sampler]")
{
    for (const Device& device : test_devices()) {
        double variance[2] = {0.0, 0.0};
        for (const std::uint32_t replicates : {1u, 2u}) {
            Scene scene = lit_floor(SamplerType::sobol, 48, 256, 3);
            scene.sampler.replicates = replicates;
            const Picture picture = render_picture(device, scene);
            RunningStatistics means;
            std::size_t unknown = 0;
            for (const PixelEstimate& pixel : picture.pixels) {
                means.add(pixel.mean.x);
                unknown += std::isinf(pixel.standard_error.x);
            }
            CHECK(unknown == (replicates == 1 ? picture.pixels.size() : 0));
            variance[replicates - 1] = means.variance();
        }
        CAPTURE(variance[0], variance[1]);
        CHECK(variance[0] < 1.2 * variance[1]);
    }
}

TEST_CASE("every sampler gives the same bits with the general and the specialised kernel, in other lanes",
          "[render][sampler]")
{
    for (const Device& device : test_devices()) {
        std::vector<Picture> pictures;
        for (const auto& [sampler, replicates] : {std::pair(SamplerType::independent, 1u),
                                                  {SamplerType::stratified, 1u},
                                                  {SamplerType::sobol, 1u},
                                                  {SamplerType::sobol, 2u}}) {
            const Scene scene = full_scene(sampler, replicates);
            PictureOptions options;
            options.lanes = 1;
            const Picture expected = render_picture(device, scene, options);
            CAPTURE(static_cast<int>(sampler), replicates);
            // In other lanes, without what the scene does not need, in launches of another size.
            options = {};
            options.specialize = true;
            options.lanes = std::array{4u, 8u, 16u}[pictures.size() % 3];
            options.shape.max_samples = 1000;
            CHECK(same_bits(render_picture(device, scene, options), expected));
            for (const Picture& other : pictures) CHECK(other.pixels[30].mean != expected.pixels[30].mean);
            pictures.push_back(expected);
        }
    }
}
