// The furnace through the same renderer, film and metrics as a study.
#include "converge/self_check.h"

#include "converge/picture.h"
#include "image/metrics.h"
#include "scene/scene_loader.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// Two-sided, of all results together: 1 in 100000.
constexpr double LARGEST_Z = 5.0;
constexpr double ALBEDO = 0.5, MEAN = 1.0 / (1.0 - ALBEDO);
constexpr std::uint64_t SAMPLES = 4, SAMPLES_OF_SERIES = 16;

const char* const ROOM = R"({
    "camera": {"position": [0.1, 0.2, -0.3], "look_at": [0.6, 0.1, 0.1], "vertical_fov": 100},
    "film": {"size": [128, 128]},
    "sampler": "independent",
    "integrator": {"type": "bsdf", "max_depth": "unlimited",
                   "roulette": {"type": "constant", "start": 0, "probability": 0.8}},
    "materials": [{"name": "wall", "type": "diffuse", "albedo": 0.5}],
    "shapes": [{"type": "box", "size": [2, 2, 2], "material": "wall", "flip_normals": true,
                "emission": {"radiance": 1}}]
})";

// Mean squared error of a picture with its standard error, from the first channel: the walls are grey, so the others
// are equal to it.
struct SquaredError {
    double mse = 0.0, standard_error = 0.0;
};

SquaredError squared_error(const Pixels& picture)
{
    // The mean is that of the metrics; the spread comes on top.
    const Metrics metrics = compare_pictures(picture, Pixels(picture.size(), Vec3(MEAN)));
    RunningStatistics squares;
    for (const Vec3& pixel : picture) squares.add((pixel.x - MEAN) * (pixel.x - MEAN));
    return {metrics.mse, squares.standard_error()};
}

SelfCheckResult judged(SelfCheckResult result)
{
    result.passed = std::abs(result.z()) <= LARGEST_Z;
    return result;
}

// Render the room; `look` gets every pass. Returns rays per sample, or 0 when stopped.
double render_room(double survival, std::uint64_t samples, const RenderOptions& options,
                   const std::function<bool()>& stop, const std::function<void(std::uint64_t, const Pixels&)>& look)
{
    Scene scene = parse_scene(ROOM, "self-check").scene;
    scene.integrator.roulette_probability = survival;
    const Geometry geometry = make_geometry(scene);
    Renderer renderer(scene, geometry, false, options);
    Film film(scene.film.width, scene.film.height, {0, 0, scene.film.width, scene.film.height}, false);
    RenderLimits limits;
    limits.samples_per_pixel = samples;
    limits.stop = stop;
    std::uint64_t rays = 0;
    limits.after_pass = [&](const PassEnd& end) {
        look(end.samples_per_pixel, pixels_of(film).mean);
        rays = end.rays;
        return true;
    };
    renderer.render(film, limits);
    if (renderer.report().interrupted) return 0.0;
    renderer.store_in_cache();
    return static_cast<double>(rays) / static_cast<double>(film.total_samples());
}

// Variance of a sample times rays per sample.
SelfCheckResult cost_result(double survival, const SquaredError& error, double samples, double rays, double pixels)
{
    SelfCheckResult result;
    result.name = fmt::format("variance times rays, q = {}", survival);
    result.expected = furnace_cost(ALBEDO, survival);
    result.found = error.mse * samples * rays;
    // Both errors as if independent; the number of rays is geometric.
    const double of_variance = error.standard_error / error.mse;
    const double of_rays = std::sqrt(survival / (samples * pixels));
    result.standard_error = result.found * std::hypot(of_variance, of_rays);
    return judged(result);
}
} // namespace

double furnace_variance(double albedo, double survival)
{
    // E X^2 = 1 + 2 a E X + (a^2 / q) E X^2.
    const double mean = 1.0 / (1.0 - albedo);
    return (1.0 + albedo) / ((1.0 - albedo) * (1.0 - albedo * albedo / survival)) - mean * mean;
}

double furnace_cost(double albedo, double survival)
{
    return furnace_variance(albedo, survival) / (1.0 - survival);
}

std::vector<SelfCheckResult> run_self_check(const RenderOptions& options, const std::function<bool()>& stop)
{
    std::vector<SelfCheckResult> results;
    for (const double survival : {0.5, 0.8, 0.95}) {
        const bool is_series = survival == 0.8;
        const std::uint64_t samples = is_series ? SAMPLES_OF_SERIES : SAMPLES;
        SquaredError error;
        double pixels = 0.0;
        const auto look = [&](std::uint64_t n, const Pixels& picture) {
            error = squared_error(picture);
            pixels = static_cast<double>(picture.size());
            if (!is_series || n == 2 || n == 8) return;
            SelfCheckResult result;
            result.name = fmt::format("MSE of {} samples, q = 0.8", n);
            result.expected = furnace_variance(ALBEDO, survival) / static_cast<double>(n);
            result.found = error.mse;
            result.standard_error = error.standard_error;
            results.push_back(judged(result));
        };
        const double rays = render_room(survival, samples, options, stop, look);
        if (rays == 0.0) break;
        results.push_back(cost_result(survival, error, static_cast<double>(samples), rays, pixels));
    }
    return results;
}

bool passed(const std::vector<SelfCheckResult>& results)
{
    return std::all_of(results.begin(), results.end(), [](const SelfCheckResult& r) { return r.passed; });
}
} // namespace etendue
