// Rendering for checks, and the moments of a picture.
#include "check/check_picture.h"

#include "check/statistics.h"
#include "geometry/geometry.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "render/replay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
std::string accident_of(const RenderReport& report, const Scene& scene, const PictureChoice& choice,
                        const DeviceInfo& device)
{
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) {
        const HealthRecord& record = report.health[kind];
        if (record.count == 0) continue;
        const AccidentPlace first = record.first.value_or(AccidentPlace{});
        std::vector<std::string> options{"--spp", std::to_string(scene.sampler.samples_per_pixel), "--device",
                                         std::to_string(device.index)};
        for (const std::string& override : choice.overrides) options.insert(options.end(), {"-D", override});
        if (choice.lenient) options.emplace_back("--lenient");
        return fmt::format("{} samples counted as zero because of {}, first pixel {},{} sample {} vertex {}: {}",
                           record.count, health_name(kind), first.x, first.y, first.sample, first.vertex,
                           replay_command(scene.file, {first.x, first.y, first.sample}, scene.sampler.seed, options));
    }
    return "";
}

void append(std::vector<std::string>& list, const std::vector<std::string>& more)
{
    list.insert(list.end(), more.begin(), more.end());
}
} // namespace

CheckPicture check_picture(const CheckContext& context, const LoadedScene& loaded, const PictureChoice& choice)
{
    Scene scene = loaded.scene;
    scene.sampler.seed += context.seed;
    scene.sampler.samples_per_pixel =
        static_cast<std::uint64_t>(static_cast<double>(scene.sampler.samples_per_pixel) * context.effort);
    const Geometry geometry = make_geometry(scene, {choice.lenient});

    RenderOptions options;
    options.devices = {context.device->info()};
    options.lanes = context.lanes;
    options.specialize = choice.other_kernel != context.specialize;
    options.cache = context.cache;
    Renderer renderer(scene, geometry, false, options);
    Film film(scene.film.width, scene.film.height, {0, 0, scene.film.width, scene.film.height}, false);
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    limits.stop = context.stop;
    renderer.render(film, limits);
    renderer.store_in_cache();

    CheckPicture picture{
        scene.film.width,  scene.film.height, {},
        renderer.report(), loaded.warnings,   accident_of(renderer.report(), scene, choice, context.device->info())};
    append(picture.warnings, geometry.warnings);
    append(picture.warnings, renderer.report().warnings);
    for (int y = 0; y < scene.film.height; ++y)
        for (int x = 0; x < scene.film.width; ++x) picture.pixels.push_back(film.estimate(x, y));
    return picture;
}

ChannelEstimate estimate_channel(const CheckPicture& picture, int channel)
{
    Moments all;
    RunningStatistics variances;
    double count = 0.0, largest = 0.0, squared_errors = 0.0, degrees = 0.0;
    bool single_samples = false;
    for (const PixelEstimate& pixel : picture.pixels) {
        const double n = static_cast<double>(pixel.samples), error = pixel.standard_error[channel];
        // A single sample says nothing of its pixel's variance.
        single_samples |= pixel.samples < 2;
        const double m2 = pixel.samples < 2 ? 0.0 : error * error * n * (n - 1.0);
        all = merge_moments(all, count, {pixel.mean[channel], m2}, n);
        count += n;
        squared_errors += pixel.samples < 2 ? 0.0 : error * error;
        degrees += n - 1.0;
        variances.add(pixel.samples < 2 ? 0.0 : error * error * n);
        largest = std::max(largest, std::abs(pixel.mean[channel]));
    }
    const double pixels = static_cast<double>(picture.pixels.size());
    ChannelEstimate estimate;
    estimate.mean = all.mean;
    estimate.variance = count < 2.0 ? INFINITY : all.m2 / (count - 1.0);
    estimate.degrees = std::max(1.0, single_samples ? count - 1.0 : degrees);
    estimate.standard_error =
        single_samples ? std::sqrt(estimate.variance / count) : std::sqrt(squared_errors) / pixels;
    estimate.variance_error = single_samples ? UNKNOWN : variances.standard_error();
    estimate.largest_share = all.mean == 0.0 ? 0.0 : largest / (std::abs(all.mean) * pixels);
    // What rounding alone brings is no variance.
    if (estimate.standard_error <= FLOAT_ROUNDING * std::abs(estimate.mean)) estimate.standard_error = 0.0;
    return estimate;
}
} // namespace etendue
