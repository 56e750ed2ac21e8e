// One program for all checks of lights.
#include "check/device_lights.h"

#include "geometry/distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace etendue
{
namespace
{
const DeviceFunctions& functions()
{
    static const DeviceFunctions all(
        {"light/light.h", "bvh/leaf.h"},
        {{"sample",
          "RenderSettings* Primitive* PrimitiveSurface* Light* AliasBucket* mask float float float uint uint uint uint "
          "-> float float float float float float float float float float float uint",
          "SceneView view;\n"
          "view.settings = in0;\n"
          "view.primitives = in1;\n"
          "view.surfaces = in2;\n"
          "view.lights = in3;\n"
          "view.light_table = in4;\n"
          "RandomBlock random = {in9, in10, in11, in12};\n"
          "LightSample s = light_sample(view, in5, vec3(in6, in7, in8), random);\n"
          "out0 = s.wi.x; out1 = s.wi.y; out2 = s.wi.z;\n"
          "out3 = s.to_light.x; out4 = s.to_light.y; out5 = s.to_light.z;\n"
          "out6 = s.radiance.x; out7 = s.radiance.y; out8 = s.radiance.z;\n"
          "out9 = s.t_max; out10 = s.pdf; out11 = s.primitive;\n"},
         {"meet",
          "RenderSettings* Primitive* PrimitiveSurface* Light* float float float float float float -> uint float float "
          "float float",
          "SceneView view;\n"
          "view.settings = in0;\n"
          "view.primitives = in1;\n"
          "view.surfaces = in2;\n"
          "view.lights = in3;\n"
          "Ray ray = {vec3(in4, in5, in6), vec3(in7, in8, in9), (Float)(INFINITE), (Uint)(NO_INDEX), "
          "(Uint)(NO_INDEX)};\n"
          "Hit hit = no_hit(ray.t_max);\n"
          "all_closest_hit(view, to_mask(true), ray, &hit);\n"
          "Mask met = hit.primitive != NO_INDEX;\n"
          "Surface surface = make_surface(view.primitives, view.surfaces, 0, met, ray, hit);\n"
          "LightHit seen = light_hit(view, surface, met, ray, hit), sky = light_escape(view);\n"
          "Color radiance = choose3(met, seen.radiance, sky.radiance);\n"
          "out0 = hit.primitive; out1 = radiance.x; out2 = radiance.y; out3 = radiance.z;\n"
          "out4 = met ? seen.pdf : sky.pdf;\n"}});
    return all;
}

void append(std::vector<DeviceArgument>& arguments, const std::vector<Point>& points)
{
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float> component;
        for (const Point& p : points) component.push_back(static_cast<float>(p[axis]));
        arguments.emplace_back(component);
    }
}

Point point(const DeviceResults& results, std::size_t first_output, std::size_t i)
{
    Point p;
    for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = std::bit_cast<float>(results.outputs[first_output + axis][i]);
    return p;
}
} // namespace

Point operator-(const Point& a, const Point& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point operator+(const Point& a, const Point& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point operator*(double s, const Point& a)
{
    return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Point& a, const Point& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a)
{
    return std::sqrt(dot(a, a));
}
Point unit(const Point& a)
{
    return 1 / length(a) * a;
}

std::array<Point, 2> complete_frame(const Point& n)
{
    const Point other = std::abs(n[0]) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0};
    const Point s = unit(cross(other, n));
    return {s, cross(n, s)};
}

std::array<double, 2> even_point(std::size_t i)
{
    constexpr double PLASTIC = 1.32471795724474602596;
    const double x = 0.5 + static_cast<double>(i) / PLASTIC, y = 0.5 + static_cast<double>(i) / (PLASTIC * PLASTIC);
    return {x - std::floor(x), y - std::floor(y)};
}

uint random_word(double u)
{
    return static_cast<uint>(u * 0x1p24) << 8;
}

void LightScene::add_area(const Primitive& primitive, const Point& radiance, double weight, uint light_flags,
                          uint surface_flags)
{
    surfaces.push_back({0, static_cast<uint>(lights.size()), NO_INDEX, surface_flags});
    lights.push_back({LIGHT_AREA, static_cast<uint>(primitives.size()), light_flags, 0,
                      make_real4(radiance[0], radiance[1], radiance[2], weight)});
    primitives.push_back(primitive);
}

void LightScene::add_dark(const Primitive& primitive)
{
    surfaces.push_back({0, NO_INDEX, NO_INDEX, 0});
    primitives.push_back(primitive);
}

void LightScene::add_environment(const Point& radiance, double weight)
{
    lights.push_back({LIGHT_ENVIRONMENT, NO_INDEX, 0, 0, make_real4(radiance[0], radiance[1], radiance[2], weight)});
}

DeviceLights::DeviceLights(const Device& device, LightScene scene, std::uint32_t lanes, bool sphere_area)
    : device_(device), lanes_(lanes), scene_(std::move(scene))
{
    std::vector<double> weights;
    for (const Light& light : scene_.lights) weights.push_back(light.radiance.s[3]);
    AliasTable table = make_alias_table(weights);
    table_ = table.buckets;
    probabilities_ = table.probabilities;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i)
        scene_.lights[i].radiance.s[3] = static_cast<float>(probabilities_[i]);

    settings_.sphere_area = sphere_area;
    settings_.primitive_count = static_cast<uint>(scene_.primitives.size());
    settings_.light_count = static_cast<uint>(scene_.lights.size());
    settings_.alias_shift = 32 - static_cast<uint>(std::countr_zero(table_.size()));
    settings_.environment_light = NO_INDEX;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i)
        if (scene_.lights[i].type == LIGHT_ENVIRONMENT) settings_.environment_light = static_cast<uint>(i);
    // Without primitives the arrays still hold something for lanes that are not active.
    if (scene_.primitives.empty()) {
        scene_.primitives.push_back({});
        scene_.surfaces.push_back({0, NO_INDEX, NO_INDEX, 0});
    }
}

std::vector<DeviceLightSample> DeviceLights::sample(const Point& from,
                                                    const std::vector<std::array<uint, 4>>& random) const
{
    return sample(from, random, std::vector<uint>(random.size(), 1));
}

std::vector<DeviceLightSample> DeviceLights::sample(const Point& from, const std::vector<std::array<uint, 4>>& random,
                                                    const std::vector<uint>& active) const
{
    std::vector<DeviceArgument> arguments{
        std::vector<RenderSettings>{settings_}, scene_.primitives, scene_.surfaces, scene_.lights, table_, active};
    append(arguments, std::vector<Point>(random.size(), from));
    for (std::size_t k = 0; k < 4; ++k) {
        std::vector<uint> words;
        for (const auto& r : random) words.push_back(r[k]);
        arguments.emplace_back(words);
    }
    const DeviceResults results = functions().evaluate(device_, "sample", arguments, lanes_);
    std::vector<DeviceLightSample> samples;
    for (std::size_t i = 0; i < random.size(); ++i)
        samples.push_back({point(results, 0, i), point(results, 3, i), point(results, 6, i),
                           std::bit_cast<float>(results.outputs[9][i]), std::bit_cast<float>(results.outputs[10][i]),
                           results.outputs[11][i]});
    return samples;
}

std::vector<DeviceLightHit> DeviceLights::meet(const Point& from, const std::vector<Point>& directions) const
{
    std::vector<DeviceArgument> arguments{std::vector<RenderSettings>{settings_}, scene_.primitives, scene_.surfaces,
                                          scene_.lights};
    append(arguments, std::vector<Point>(directions.size(), from));
    append(arguments, directions);
    const DeviceResults results = functions().evaluate(device_, "meet", arguments, lanes_);
    std::vector<DeviceLightHit> hits;
    for (std::size_t i = 0; i < directions.size(); ++i)
        hits.push_back({results.outputs[0][i], point(results, 1, i), std::bit_cast<float>(results.outputs[4][i])});
    return hits;
}

std::vector<std::array<uint, 4>> even_words(std::size_t count)
{
    std::vector<std::array<uint, 4>> words = random_words(count, 41);
    for (std::size_t i = 0; i < count; ++i) {
        words[i][2] = random_word(even_point(i)[0]);
        words[i][3] = random_word(even_point(i)[1]);
    }
    return words;
}
} // namespace etendue
