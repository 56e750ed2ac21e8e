// Bits that are the same on every device that rounds as it promises, as SHA-256; and how fast a small scene is.
#include "check/committed_bits.h"
#include "check/device_checks.h"
#include "check/device_functions.h"
#include "check/findings.h"
#include "check/primitive_sets.h"

#include "bvh/lbvh_builder.h"
#include "render/render_settings.h"
#include "render/renderer.h"
#include "scene/scene_loader.h"
#include "util/sha256.h"

#include <bit>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Results = std::vector<CheckResult>;

// Without a distribution of the standard library, whose numbers differ between libraries.
std::vector<Primitive> fixed_triangles()
{
    std::vector<Primitive> set;
    std::uint32_t state = 1;
    const auto number = [&] {
        return static_cast<double>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-23 - 1;
    };
    for (int i = 0; i < 4096; ++i) {
        const double x = number(), y = number();
        set.push_back(triangle_at(x, y, number(), 0.01));
    }
    return set;
}

// Every BSDF, kind of light and of shape, roulette and a filter.
const char* const SCENE = R"({
    "camera": {"position": [0, 1, 6.8], "look_at": [0, 1, 0], "vertical_fov": 19.5},
    "film": {"size": [16, 16], "filter": "gaussian"},
    "integrator": {"type": "path", "max_depth": "unlimited", "roulette": "throughput"},
    "sampler": {"spp": 16},
    "materials": [
        {"name": "white", "type": "diffuse", "albedo": 0.75},
        {"name": "mirror", "type": "mirror", "reflectance": 0.95},
        {"name": "glass", "type": "dielectric", "ior": 1.5, "tint": [0.98, 1, 0.99]}
    ],
    "shapes": [
        {"type": "rectangle", "size": [2, 2], "material": "white",
         "transform": {"rotate": {"axis": [1, 0, 0], "angle": -90}}},
        {"type": "rectangle", "size": [2, 2], "material": "white", "transform": {"translate": [0, 1, -1]}},
        {"type": "disk", "radius": 0.3, "material": "white", "transform": {"translate": [-0.6, 1.4, -0.5]}},
        {"type": "sphere", "radius": 0.4, "material": "glass", "transform": {"translate": [0.4, 0.4, 0.35]}},
        {"type": "box", "size": [0.55, 1.1, 0.55], "material": "mirror",
         "transform": [{"rotate": {"axis": [0, 1, 0], "angle": 25}}, {"translate": [-0.4, 0.55, -0.3]}]}
    ],
    "lights": [
        {"type": "sphere", "radius": 0.15, "radiance": [45, 40, 33], "transform": {"translate": [0, 1.7, 0]}}
    ],
    "environment": {"radiance": [0.1, 0.2, 0.3]}
})";

template<typename T>
std::string hash_of(const std::vector<T>& values)
{
    return sha256({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

// Equal to what is committed. Where division and roots may be rounded otherwise a difference is told, not judged.
CheckResult compare_bits(const CheckContext& context, const std::string& name, const std::string& found,
                         const std::string& expected, bool divides)
{
    CheckResult result;
    result.name = name;
    result.rule = Rule::exact;
    result.expected = expected.substr(0, 16);
    result.found = found.substr(0, 16);
    result.statistic = found == expected ? 0.0 : 1.0;
    result.unit = "violations";
    result.critical = 0.0;
    result.note = "SHA-256 " + found;
    const bool may_differ = divides && !context.device->info().correctly_rounded_divide;
    if (found != expected && may_differ)
        result.note += "; the device does not promise correctly rounded division and roots, so it may differ";
    result.verdict = found == expected || may_differ ? Verdict::passed : Verdict::failed;
    return result;
}

Results check_philox_bits(const CheckContext& context)
{
    static const DeviceFunctions functions(
        {"sampling/random.h"}, {{"block", "uint uint uint -> uint uint uint uint",
                                 "RandomStream s = {1u, 2u, 3u, in0, in1}; RandomBlock b = random_block(s, in2);"
                                 "out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"}});
    std::vector<uint> pixel, sample, dimension;
    for (uint i = 0; i < 4096; ++i) {
        pixel.push_back(i * 2654435761u);
        sample.push_back(i);
        dimension.push_back(i % 64);
    }
    const DeviceResults out = functions.evaluate(*context.device, "block", {pixel, sample, dimension}, context.lanes);
    std::vector<uint> words;
    for (const auto& column : out.outputs) words.insert(words.end(), column.begin(), column.end());
    return {compare_bits(context, "device-bits-philox", hash_of(words), COMMITTED_PHILOX, false)};
}

Results check_tree_bits(const CheckContext& context)
{
    LbvhBuilder builder(*context.device, context.cache);
    const std::vector<Primitive> set = fixed_triangles();
    const Buffer<Primitive> primitives(*context.device, "primitives", set);
    const Bvh bvh = download(builder.build(primitives, static_cast<std::uint32_t>(set.size())));
    const std::string both = hash_of(bvh.nodes) + hash_of(bvh.leaf_primitives);
    return {compare_bits(context, "device-bits-tree", sha256(both), COMMITTED_TREE, true)};
}

struct Rendered {
    std::vector<float> film;
    double rays_per_second = 0.0;
    std::uint64_t accidents = 0;
};

Rendered render(const CheckContext& context, std::uint32_t lanes, int size, std::uint64_t samples)
{
    Scene scene = parse_scene(SCENE, "scene of the device checks").scene;
    scene.film.width = scene.film.height = size;
    scene.sampler.samples_per_pixel = samples;
    const Geometry geometry = make_geometry(scene);
    RenderOptions options;
    options.devices = {context.device->info()};
    options.lanes = lanes;
    options.cache = context.cache;
    Renderer renderer(scene, geometry, false, options);
    Film film(size, size, {0, 0, size, size}, false);
    RenderLimits limits;
    limits.samples_per_pixel = wanted_samples(scene);
    limits.stop = context.stop;
    renderer.render(film, limits);
    renderer.store_in_cache();
    Rendered rendered{{}, renderer.report().rays_per_second(), renderer.report().accidents()};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Vec3 mean = film.estimate(x, y).mean;
            for (int channel = 0; channel < 3; ++channel) rendered.film.push_back(static_cast<float>(mean[channel]));
        }
    return rendered;
}

// A film by one lane and by many: the same bits, the committed ones. A larger one for the time.
Results check_film(const CheckContext& context)
{
    const std::uint32_t preferred = context.device->preferred_lanes(), many = preferred > 1 ? preferred : 4;
    const Rendered one = render(context, 1, 16, 16), other = render(context, many, 16, 16);
    Violations lanes, accidents;
    lanes.set_subject(fmt::format("1 and {} lanes", many));
    for (std::size_t i = 0; i < one.film.size(); ++i)
        lanes.expect(std::bit_cast<std::uint32_t>(one.film[i]) == std::bit_cast<std::uint32_t>(other.film[i]),
                     "values that differ");
    accidents.add_trials(2 * 16 * 16 * 16);
    accidents.add("samples with an accident", one.accidents + other.accidents);

    const Rendered large = render(context, preferred, 128, 4);
    CheckResult speed;
    speed.name = "device-film-speed";
    speed.rule = Rule::exact;
    speed.expected = "reported";
    speed.statistic = large.rays_per_second / 1e6;
    speed.found = fmt::format("{:.2f}", speed.statistic);
    speed.unit = "Mrays/s";
    speed.verdict = Verdict::passed;
    speed.note = fmt::format("{} lanes, 128 x 128 pixels, 4 samples", preferred);
    return {compare_bits(context, "device-film-bits", hash_of(one.film), COMMITTED_FILM, true),
            lanes.result("device-film-lanes", Rule::exact), accidents.result("device-film-accidents"), speed};
}
} // namespace

std::vector<Check> bits_checks()
{
    return {make_check("device", "device-bits-philox", check_philox_bits),
            make_check("device", "device-bits-tree", check_tree_bits), make_check("device", "device-film", check_film)};
}
} // namespace etendue
