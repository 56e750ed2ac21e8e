// The course's box: the means that another renderer finds, and the picture of an independent tracer.
#include "scene/scene_loader.h"
#include "support/device_evaluate.h"
#include "support/render_scene.h"
#include "support/render_statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <tuple>

using namespace etendue;

namespace
{
// Mitsuba 3.9.1 at 256x256, box filter, 28672 samples per pixel, no limit of depth; standard error 2e-6.
const Vec3 MEAN{0.2795071, 0.1733809, 0.0627627};
// The same without the pixels that see any of the light.
const Vec3 MEAN_WITHOUT_LIGHT{0.168218, 0.094655, 0.029893};

Scene course_box(IntegratorType integrator, int size, std::uint64_t samples_per_pixel)
{
    Scene scene = load_scene(ETENDUE_SOURCE_DIR "/scenes/course-box/simple.json").scene;
    scene.integrator.type = integrator;
    scene.integrator.max_depth.reset();
    scene.film.width = scene.film.height = size;
    scene.sampler.type = SamplerType::independent; // tests of means use the variance of a pixel's samples
    scene.sampler.samples_per_pixel = samples_per_pixel;
    return scene;
}
} // namespace

TEST_CASE("every integrator finds the mean of the course box that another renderer finds", "[render][course]")
{
    MeanTests means("course box");
    // Pixels at the edge of the light bring most of the error, and small pixels have few of them.
    for (const Device& device : test_devices())
        for (const auto& [integrator, samples, smallest_bias] :
             {std::tuple(IntegratorType::hemisphere, 48, 0.03), std::tuple(IntegratorType::bsdf, 48, 0.03),
              std::tuple(IntegratorType::light, 32, 0.01), std::tuple(IntegratorType::path, 32, 0.01)}) {
            CAPTURE(static_cast<int>(integrator));
            means.check(render_picture(device, course_box(integrator, 256, samples)), MEAN, smallest_bias);
        }
}

TEST_CASE("the course box without the pixels of its light has its mean too", "[render][course]")
{
    MeanTests means("course box without its light");
    for (const Device& device : test_devices()) {
        Scene scene = course_box(IntegratorType::path, 256, 64);
        scene.integrator.max_depth = 0;
        const Picture emission = render_picture(device, scene);
        scene.sampler.samples_per_pixel = 32;
        scene.integrator.max_depth.reset();
        const Picture picture = render_picture(device, scene);
        Picture kept;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i)
            if (emission.pixels[i].mean == Vec3(0.0)) kept.pixels.push_back(picture.pixels[i]);
        // 504 pixels see the light, some of them too little of it to be found by 64 samples.
        CHECK(std::abs(static_cast<double>(picture.pixels.size() - kept.pixels.size()) - 504.0) < 8.0);
        means.check(kept, MEAN_WITHOUT_LIGHT, 0.005);
    }
}

TEST_CASE("the course box is the picture of an independent tracer", "[render][course]")
{
    MeanTests means("course box by tiles");
    ReferenceOptions options;
    options.batches = 40;
    const Scene scene = course_box(IntegratorType::path, 96, 64);
    const Picture reference = as_picture(scene, render_reference(scene, options), options);
    for (const Device& device : test_devices())
        for (const bool specialize : {false, true}) {
            CAPTURE(specialize);
            PictureOptions how;
            how.specialize = specialize;
            means.check_same(render_picture(device, scene, how), reference, 8, 0.035);
        }
}

TEST_CASE("the course box is 0.47 % darker with a limit of seven vertices", "[render][course]")
{
    // The luminance of the same paths, cut off or not; the other renderer's number has two digits.
    for (const Device& device : test_devices()) {
        Scene scene = course_box(IntegratorType::path, 64, 256);
        const auto luminance = [&] {
            const Picture picture = render_picture(device, scene);
            return 0.2126 * estimate_of(picture, 0).mean + 0.7152 * estimate_of(picture, 1).mean +
                   0.0722 * estimate_of(picture, 2).mean;
        };
        const double whole = luminance();
        scene.integrator.max_depth = 7;
        CHECK((whole - luminance()) / whole == Approx(0.0047).epsilon(0.05));
    }
}
