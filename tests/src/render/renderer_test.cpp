// Passes over several devices: limits, progress, stopping, failures and the report.
#include "compute/kernel_source.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "scene/scene_loader.h"
#include "support/child_process.h"
#include "support/device_evaluate.h"
#include "util/environment.h"
#include "util/error.h"
#include "util/file.h"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace etendue;
using Catch::Contains;

namespace
{
constexpr std::uint64_t PIXELS = 12 * 10;

const char* const SCENE = R"({
    "camera": {"position": [0, 1, 5], "look_at": [0, 1, 0]},
    "film": {"size": [12, 10]},
    "integrator": {"type": "path", "max_depth": 3},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5}],
    "shapes": [{"type": "rectangle", "size": [2, 2], "material": "grey", "transform": {"translate": [0, 1, 0]}}],
    "environment": {"radiance": [1, 2, 3]}
})";

// A scene ready to be rendered; without AOVs.
struct Bench {
    explicit Bench(const std::vector<std::string>& overrides = {}, std::optional<PixelRect> crop = {})
        : scene(parse_scene(SCENE, "renderer.json", overrides).scene), geometry(make_geometry(scene)),
          film(scene.film.width, scene.film.height, crop.value_or(PixelRect{0, 0, scene.film.width, scene.film.height}),
               false)
    {
        options.devices = {test_devices().front().info()};
        options.shape.max_samples = 200;
    }

    void twice() { options.devices.push_back(options.devices.front()); }

    RenderReport render(const RenderLimits& limits)
    {
        Renderer renderer(scene, geometry, false, options);
        renderer.render(film, limits);
        return renderer.report();
    }

    Scene scene;
    Geometry geometry;
    Film film;
    RenderOptions options;
};

RenderLimits limits_of(std::uint64_t samples)
{
    RenderLimits limits;
    limits.samples_per_pixel = samples;
    return limits;
}
} // namespace

TEST_CASE("a render gives every pixel its samples and reports what it did", "[render]")
{
    Bench bench;
    bench.twice();
    const RenderReport report = bench.render(limits_of(70));
    CHECK(bench.film.min_samples() == 70);
    CHECK(bench.film.total_samples() == 70 * PIXELS);
    CHECK(report.samples_per_pixel == 70);
    CHECK_FALSE(report.interrupted);
    CHECK(report.counts[COUNT_CAMERA_RAYS] == 70 * PIXELS);
    CHECK(report.counts[COUNT_INDIRECT_RAYS] > 0);
    CHECK(report.counts[COUNT_SHADOW_RAYS] > 0);
    CHECK(report.accidents() == 0);
    CHECK(report.accelerator == ACCELERATOR_BRUTE_FORCE);
    CHECK(report.setup_seconds > 0.0);
    CHECK(report.render_seconds >= report.first_launch_seconds);
    CHECK(report.rays_per_second() > 0.0);
    REQUIRE(report.devices.size() == 2);
    std::uint64_t samples = 0;
    for (const DeviceReport& device : report.devices) {
        samples += device.samples;
        CHECK(device.info.name == bench.options.devices.front().name);
        CHECK(device.compute_units == bench.options.devices.front().compute_units);
        CHECK(device.upload_seconds > 0.0);
        CHECK(device.compile_seconds > 0.0);
        CHECK(device.memory.peak > 0);
        REQUIRE(device.builds.size() == 2);
        CHECK(device.builds[0].program == "path_megakernel.cl");
        CHECK(device.builds[1].program == "film.cl");
    }
    CHECK(samples == 70 * PIXELS);
}

TEST_CASE("a tree built by kernels is reported with its programs", "[render]")
{
    Bench bench({R"(accelerator={"type":"lbvh","build":"device"})"});
    const RenderReport report = bench.render(limits_of(1));
    CHECK(report.accelerator == ACCELERATOR_LBVH);
    const DeviceReport& device = report.devices.at(0);
    CHECK(device.bvh.primitive_count == 2);
    CHECK(device.bvh.built_on_device);
    CHECK(device.bvh_seconds > 0.0);
    REQUIRE(device.builds.size() == 4);
    CHECK(device.builds[2].program == "bvh_build.cl");
    CHECK(device.builds[3].program == "sort.cl");
}

TEST_CASE("films of one pixel and crops of one pixel render", "[render]")
{
    Bench bench({"film.size=[1,1]"});
    CHECK(bench.render(limits_of(65)).samples_per_pixel == 65);
    CHECK(bench.film.total_samples() == 65);
    Bench corner({}, PixelRect{11, 9, 1, 1});
    CHECK(corner.render(limits_of(65)).samples_per_pixel == 65);
    CHECK(corner.film.total_samples() == 65);
}

TEST_CASE("progress grows to the whole, and the last word has every ray", "[render]")
{
    Bench bench;
    bench.twice();
    RenderLimits limits = limits_of(40);
    RenderProgress last;
    std::size_t calls = 0;
    limits.progress = [&](const RenderProgress& now) {
        ++calls;
        CHECK(now.fraction > last.fraction);
        CHECK(now.samples_per_pixel >= last.samples_per_pixel);
        CHECK(now.rays > last.rays);
        last = now;
    };
    const RenderReport report = bench.render(limits);
    // Launches of at most 200 samples.
    CHECK(calls >= 40 * PIXELS / 200);
    CHECK(last.fraction == 1.0);
    CHECK(last.samples_per_pixel == 40);
    CHECK(last.rays == report.rays());
}

TEST_CASE("a render that is stopped keeps the samples it has", "[render]")
{
    Bench bench;
    RenderLimits limits = limits_of(1'000'000'000'000);
    int launches = 0;
    limits.progress = [&](const RenderProgress&) { ++launches; };
    limits.stop = [&] { return launches >= 100; };
    const RenderReport report = bench.render(limits);
    CHECK(report.interrupted);
    CHECK(launches == 100);
    CHECK(report.samples_per_pixel == bench.film.min_samples());
    CHECK(bench.film.min_samples() > 0);
    CHECK(bench.film.total_samples() == report.counts[COUNT_CAMERA_RAYS]);
}

TEST_CASE("a render that is stopped before it begins has no samples", "[render]")
{
    Bench bench;
    RenderLimits limits = limits_of(4);
    limits.stop = [] { return true; };
    const RenderReport report = bench.render(limits);
    CHECK(report.interrupted);
    CHECK(bench.film.total_samples() == 0);
    CHECK(report.rays() == 0);
}

TEST_CASE("time ends a render after whole passes, at least one", "[render]")
{
    for (const double seconds : {1e-9, 0.2}) {
        Bench bench;
        RenderLimits limits = limits_of(1'000'000'000'000);
        limits.seconds = seconds;
        const RenderReport report = bench.render(limits);
        CHECK_FALSE(report.interrupted);
        CHECK(report.samples_per_pixel >= 1);
        CHECK(bench.film.total_samples() == report.samples_per_pixel * PIXELS);
    }
}

TEST_CASE("a failure on any device ends the render with its message", "[render]")
{
    Bench bench;
    bench.twice();
    RenderLimits limits = limits_of(1'000'000'000'000);
    int launches = 0;
    limits.progress = [&](const RenderProgress&) {
        if (++launches == 30) throw std::runtime_error("the thirtieth launch");
    };
    CHECK_THROWS_WITH(bench.render(limits), "the thirtieth launch");
    // The rest of its pass, a dozen launches, is given up.
    CHECK(launches < 36);
}

TEST_CASE("accidents are reported with the first pixel and sample", "[render]")
{
    // A wall covers the upper half of the picture; below it is the sky, and no path goes on.
    Bench bench({R"(shapes.0={"type":"rectangle","size":[40,20],"material":"grey","transform":{"translate":[0,11,0]}})",
                 "integrator.max_depth=0"});
    bench.twice();
    bench.geometry.lights.back().radiance.s[0] = std::numeric_limits<float>::infinity();
    const RenderReport report = bench.render(limits_of(5));
    const HealthRecord& record = report.health[HEALTH_NON_FINITE_RADIANCE];
    CHECK(record.count == 5 * PIXELS / 2);
    CHECK(report.accidents() == record.count);
    REQUIRE(record.first);
    CHECK(record.first->sample == 0);
    CHECK(record.first->x == 0);
    CHECK(record.first->y == 5);
    CHECK(record.first->vertex == 0);
}

TEST_CASE("impossible lanes and threads are refused", "[render]")
{
    Bench bench;
    bench.options.lanes = 3;
    CHECK_THROWS_AS(bench.render(limits_of(1)), UsageError);
    CHECK_THROWS_WITH(bench.render(limits_of(1)), "A work-item can carry 1, 4, 8 or 16 lanes, not 3.");
    bench.options.lanes = 0;
    bench.options.threads = bench.options.devices.front().compute_units + 1;
    CHECK_THROWS_AS(bench.render(limits_of(1)), DeviceError);
    CHECK_THROWS_WITH(bench.render(limits_of(1)),
                      Contains(std::to_string(bench.options.threads) + " threads were asked for"));
}

namespace
{
// The canary's program under a compiler that takes 0 - x for -x.
class LaxCanary
{
public:
    LaxCanary() : before_(environment("ETENDUE_CL_DIR"))
    {
        std::string text = kernel_file("canary.cl");
        const std::string strict = "0.0 - x";
        text.replace(text.find(strict), strict.size(), "-x");
        write_file((folder_.path() / "canary.cl").string(), text);
        set_environment("ETENDUE_CL_DIR", folder_.path().string());
    }
    ~LaxCanary() { set_environment("ETENDUE_CL_DIR", before_); }
    LaxCanary(const LaxCanary&) = delete;
    LaxCanary& operator=(const LaxCanary&) = delete;

private:
    TemporaryFolder folder_;
    std::string before_;
};
} // namespace

TEST_CASE("a device whose canary fails renders nothing, unless fast math was asked for", "[render]")
{
    const LaxCanary lax;
    Bench strict, fast;
    CHECK_THROWS_AS(strict.render(limits_of(1)), DeviceError);
    CHECK_THROWS_WITH(strict.render(limits_of(1)), Contains("signed_zeros") && Contains("--fast-math"));
    fast.options.fast_math = true;
    const RenderReport report = fast.render(limits_of(1));
    CHECK(report.fast_math);
    CHECK_FALSE(report.devices.front().canary.passed);
    CHECK(report.devices.front().builds.front().options.find("-cl-fast-relaxed-math") != std::string::npos);
    CHECK(report.devices.front().builds.at(1).options.find("-cl-fast-relaxed-math") == std::string::npos);
}

TEST_CASE("a strict render asks the canary and adds no option to its kernels", "[render]")
{
    Bench bench;
    const RenderReport report = bench.render(limits_of(1));
    CHECK_FALSE(report.fast_math);
    CHECK(report.devices.front().canary.passed);
    for (const BuildReport& build : report.devices.front().builds)
        CHECK(build.options.find("fast") == std::string::npos);
}

TEST_CASE("a warm-up changes nothing but what the first launch costs", "[render]")
{
    Bench cold, warm;
    cold.render(limits_of(3));
    Renderer renderer(warm.scene, warm.geometry, false, warm.options);
    renderer.warm_up();
    renderer.render(warm.film, limits_of(3));
    const RenderReport& report = renderer.report();
    CHECK(report.warm_up_seconds > 0.0);
    CHECK(report.counts[COUNT_CAMERA_RAYS] == 3 * PIXELS);
    CHECK(report.devices.at(0).samples == 3 * PIXELS);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 12; ++x) CHECK(warm.film.estimate(x, y).mean == cold.film.estimate(x, y).mean);
}

TEST_CASE("the end of each pass has the rays and the devices' seconds so far", "[render]")
{
    Bench bench;
    bench.twice();
    RenderLimits limits = limits_of(128);
    std::vector<PassEnd> ends;
    limits.after_pass = [&](const PassEnd& end) {
        ends.push_back(end);
        return true;
    };
    const RenderReport report = bench.render(limits);
    REQUIRE(ends.size() == 8);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        CHECK(ends[i].rays > ends[i - 1].rays);
        CHECK(ends[i].kernel_seconds > ends[i - 1].kernel_seconds);
    }
    CHECK(ends.back().rays == report.rays());
    // Two devices work at the same time.
    CHECK(ends.back().kernel_seconds <= 2 * ends.back().render_seconds);
    CHECK(ends.back().kernel_seconds == report.devices[0].kernel_seconds + report.devices[1].kernel_seconds);
}
