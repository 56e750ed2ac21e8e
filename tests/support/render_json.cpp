// Rendering for tests.
#include "support/render_json.h"

#include "geometry/geometry.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "scene/scene_loader.h"
#include "util/statistics.h"

#include <cmath>

#include <fmt/format.h>

namespace etendue
{
Vec3 JsonPicture::mean() const
{
    Vec3 sum(0.0);
    for (const PixelEstimate& p : pixels) sum += p.mean;
    return sum / static_cast<double>(pixels.size());
}

Vec3 JsonPicture::standard_error() const
{
    Vec3 sum(0.0);
    for (const PixelEstimate& p : pixels) sum += p.standard_error * p.standard_error;
    return glm::sqrt(sum) / static_cast<double>(pixels.size());
}

std::uint64_t JsonPicture::samples() const
{
    std::uint64_t sum = 0;
    for (const PixelEstimate& p : pixels) sum += p.samples;
    return sum;
}

JsonPicture render_json(const Device& device, const Scene& scene, JsonPictureOptions options)
{
    const Geometry geometry = make_geometry(scene);
    RenderOptions render_options;
    render_options.devices = {device.info()};
    render_options.specialize = options.specialize;
    render_options.lanes = options.lanes;
    Renderer renderer(scene, geometry, false, render_options);
    Film film(scene.film.width, scene.film.height, {0, 0, scene.film.width, scene.film.height}, false);
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    renderer.render(film, limits);
    JsonPicture picture;
    picture.width = scene.film.width;
    for (int y = 0; y < scene.film.height; ++y)
        for (int x = 0; x < scene.film.width; ++x) picture.pixels.push_back(film.estimate(x, y));
    picture.report = renderer.report();
    return picture;
}

JsonPicture render_json(const Device& device, const std::string& json, const std::vector<std::string>& overrides,
                        JsonPictureOptions options)
{
    return render_json(device, parse_scene(json, "test.json", overrides).scene, options);
}

Verdict judge(double found, double standard_error, double expected, std::size_t tests, double wanted)
{
    Verdict v;
    v.critical = normal_quantile(1.0 - sidak_alpha(1e-3, tests) / 2.0);
    v.z = (found - expected) / standard_error;
    v.detectable = (v.critical + 2.33) * standard_error / std::abs(expected);
    v.passed = std::abs(v.z) <= v.critical;
    v.has_power = v.detectable <= wanted;
    v.text = fmt::format("found {} +- {}, expected {}: z {:.2f} of {:.2f}, smallest bias seen {:.3f} %{}", found,
                         standard_error, expected, v.z, v.critical, 100.0 * v.detectable,
                         v.has_power ? "" : " UNDERPOWERED");
    return v;
}
} // namespace etendue
