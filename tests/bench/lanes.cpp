// Prints paths per second and the share of busy lanes for 1, 4, 8 and 16 lanes per work-item, interleaved in one
// process, medians of several runs: lanes SCENE [RUNS] [SPP] [SIZE].
#include "geometry/geometry.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "scene/scene_loader.h"
#include "util/statistics.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

using namespace etendue;

namespace
{
struct Run {
    double paths_per_second = 0.0;
    double busy_lanes = 0.0;
};

// One render; the first launch, in which drivers compile, is left out of the time.
Run render_once(const Scene& scene, const Geometry& geometry, const DeviceInfo& device, std::uint32_t lanes)
{
    RenderOptions options;
    options.devices = {device};
    options.lanes = lanes;
    options.cache = KernelCache::standard();
    Renderer renderer(scene, geometry, false, options);
    Film film(scene.film.width, scene.film.height, {0, 0, scene.film.width, scene.film.height}, false);
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    renderer.render(film, limits);
    const DeviceReport& report = renderer.report().devices.front();
    return {static_cast<double>(report.samples - report.first_launch_samples) / report.render_seconds,
            renderer.report().busy_lanes()};
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}
} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::cerr << "usage: lanes SCENE [RUNS] [SPP] [SIZE] [ACCELERATOR]\n";
        return 1;
    }
    const int runs = argc > 2 ? std::stoi(argv[2]) : 5;
    Scene scene = load_scene(argv[1]).scene;
    scene.sampler.samples_per_pixel = argc > 3 ? std::stoul(argv[3]) : 16;
    if (argc > 4) scene.film.width = scene.film.height = std::stoi(argv[4]);
    if (argc > 5) scene.accelerator.type = std::string(argv[5]) == "lbvh" ? ACCELERATOR_LBVH : ACCELERATOR_BRUTE_FORCE;
    const Geometry geometry = make_geometry(scene);
    const DeviceInfo device = select_devices(list_devices(), "auto").front();

    std::map<std::uint32_t, std::vector<double>> speeds;
    std::map<std::uint32_t, double> busy;
    for (int run = 0; run < runs; ++run) {
        for (const std::uint32_t lanes : {1u, 4u, 8u, 16u}) {
            const Run result = render_once(scene, geometry, device, lanes);
            speeds[lanes].push_back(result.paths_per_second);
            busy[lanes] = result.busy_lanes;
        }
    }
    fmt::print("{} on {}, {} runs\n  lanes  Mpaths/s  over 1 lane  busy lanes\n", argv[1], device.name, runs);
    const double single = median(speeds[1]);
    for (const auto& [lanes, values] : speeds)
        fmt::print("  {:5}  {:8.3f}  {:11.2f}  {:10.3f}\n", lanes, median(values) / 1e6, median(values) / single,
                   busy[lanes]);
    return 0;
}
