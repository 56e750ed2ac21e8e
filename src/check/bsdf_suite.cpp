// One program that evaluates and samples whatever material.
#include "check/bsdf_suite.h"

#include "scene/material_parser.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <random>

namespace etendue
{
namespace
{
constexpr double PI = std::numbers::pi;

const char* BSDF_INPUTS = "Material* float* uint float float float";
const char* LOAD_MATERIAL = "SceneView view;\n"
                            "view.materials = in0;\n"
                            "view.parameters = in1;\n"
                            "Mask active = to_mask(true);\n"
                            "MaterialLanes m = load_material(view, in2, active);\n"
                            "Vec3 wo = vec3(in3, in4, in5);\n";

const DeviceFunctions& functions()
{
    static const DeviceFunctions all(
        {"bsdf/bsdf.h"},
        {{"evaluate", std::string(BSDF_INPUTS) + " float float float -> float float float float",
          std::string(LOAD_MATERIAL) + "Vec3 wi = vec3(in6, in7, in8);\n"
                                       "Color f = bsdf_evaluate(view, m, active, wo, wi);\n"
                                       "out0 = f.x; out1 = f.y; out2 = f.z;\n"
                                       "out3 = bsdf_pdf(view, m, active, wo, wi);\n"},
         {"sample",
          std::string(BSDF_INPUTS) + " uint uint uint uint -> float float float float float float float mask float",
          std::string(LOAD_MATERIAL) + "RandomBlock random = {in6, in7, in8, in9};\n"
                                       "BsdfSample s = bsdf_sample(view, m, active, wo, random);\n"
                                       "out0 = s.wi.x; out1 = s.wi.y; out2 = s.wi.z;\n"
                                       "out3 = s.weight.x; out4 = s.weight.y; out5 = s.weight.z;\n"
                                       "out6 = s.pdf; out7 = s.delta; out8 = s.radiance_scale;\n"}});
    return all;
}

// Each double comes back as the sum of two floats: 48 of its 53 digits.
const DeviceFunctions& functions_in_double()
{
    static const DeviceFunctions all = [] {
        Specialization features = Specialization::everything(1, 64);
        features.precision = Precision::fp64;
        return DeviceFunctions(
            {"bsdf/bsdf.h"},
            {{"invert", "Material* real* uint float float float float float float -> float float float float",
              std::string(LOAD_MATERIAL) +
                  "BsdfInverse inverse = bsdf_invert(view, m, active, wo, vec3(in6, in7, in8));\n"
                  "out0 = inverse.u; out1 = out0 - (float)out0;\n"
                  "out2 = inverse.v; out3 = out2 - (float)out2;\n"}},
            "", features);
    }();
    return all;
}

// One list per component.
template<typename T, std::size_t N>
void append_components(std::vector<DeviceArgument>& arguments, const std::vector<std::array<T, N>>& vectors)
{
    for (std::size_t k = 0; k < N; ++k) {
        std::vector<T> component;
        for (const auto& v : vectors) component.push_back(v[k]);
        arguments.emplace_back(component);
    }
}

template<typename Real>
std::vector<DeviceArgument> material_arguments(const std::vector<BsdfCase>& cases, const std::vector<uint>& which,
                                               const std::vector<Direction>& wo)
{
    std::vector<Material> materials;
    std::vector<Real> parameters;
    for (const BsdfCase& c : cases) {
        materials.push_back({static_cast<uint>(c.type), 0, static_cast<uint>(parameters.size()), 0});
        parameters.insert(parameters.end(), c.parameters.begin(), c.parameters.end());
    }
    std::vector<DeviceArgument> arguments{materials, parameters, which};
    append_components(arguments, wo);
    return arguments;
}
} // namespace

Direction direction(double z, double phi)
{
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)};
}

std::vector<Direction> sphere_grid(std::size_t rows, std::size_t columns)
{
    std::vector<Direction> grid;
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < columns; ++k)
            grid.push_back(direction(-1 + (2 * static_cast<double>(i) + 1) / static_cast<double>(rows),
                                     2 * PI * (static_cast<double>(k) + 0.5) / static_cast<double>(columns)));
    return grid;
}

std::vector<BsdfCase> bsdf_cases(BsdfType type)
{
    std::mt19937 random(static_cast<unsigned>(type) + 1);
    std::uniform_real_distribution<double> uniform(0, 1);
    // Where in the range each parameter lies: at an end, or anywhere; below 0 is the default.
    const auto make = [&](auto place) {
        BsdfCase c{type, {}, bsdf_name(type)};
        const std::vector<double> standard = default_material(type).parameters;
        for (const BsdfParameter& row : bsdf_parameters()) {
            if (row.bsdf != type) continue;
            const Range& range = row.property.range;
            for (int k = 0; k < (row.property.kind == Kind::colour ? 3 : 1); ++k) {
                const double t = place(), low = range.low, high = range.high;
                // A wide range of positive numbers is one of ratios.
                const double value =
                    low > 0 && high > 10 * low ? low * std::pow(high / low, t) : low + (high - low) * t;
                c.parameters.push_back(static_cast<float>(t < 0 ? standard[c.parameters.size()] : value));
            }
        }
        c.name += fmt::format(" {}", fmt::join(c.parameters, " "));
        return c;
    };
    std::vector<BsdfCase> cases{make([] { return -1.0; }), make([] { return 0.0; }), make([] { return 1.0; })};
    for (int i = 0; i < 3; ++i) cases.push_back(make([&] { return uniform(random); }));
    return cases;
}

std::vector<Direction> standard_directions()
{
    std::vector<Direction> directions;
    double phi = 0.3;
    for (const double side : {1.0, -1.0})
        for (const double z : {1.0, 0.9, 0.5, 0.1, 0.01, 0.001}) directions.push_back(direction(side * z, phi += 1.1));
    return directions;
}

DeviceBsdf::Evaluation DeviceBsdf::evaluate(std::vector<Direction> wo, const std::vector<Direction>& wi) const
{
    if (wo.size() == 1) wo.resize(wi.size(), wo[0]);
    std::vector<DeviceArgument> arguments = material_arguments<float>({bsdf_}, std::vector<uint>(wi.size(), 0), wo);
    append_components(arguments, wi);
    const DeviceResults results = functions().evaluate(device_, "evaluate", arguments, lanes_);
    Evaluation evaluation{std::vector<std::array<float, 3>>(wi.size()), results.get<float>(3)};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<float> f = results.get<float>(k);
        for (std::size_t i = 0; i < f.size(); ++i) evaluation.f[i][k] = f[i];
    }
    return evaluation;
}

std::vector<DeviceBsdf::Sample> DeviceBsdf::sample(std::vector<Direction> wo,
                                                   const std::vector<RandomWords>& random) const
{
    if (wo.size() == 1) wo.resize(random.size(), wo[0]);
    std::vector<DeviceArgument> arguments = material_arguments<float>({bsdf_}, std::vector<uint>(random.size(), 0), wo);
    append_components(arguments, random);
    const DeviceResults results = functions().evaluate(device_, "sample", arguments, lanes_);
    std::vector<std::vector<float>> out;
    for (const std::size_t k : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 8u}) out.push_back(results.get<float>(k));
    const std::vector<uint> delta = results.get<uint>(7);
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < random.size(); ++i)
        samples.push_back({{out[0][i], out[1][i], out[2][i]},
                           {out[3][i], out[4][i], out[5][i]},
                           out[6][i],
                           delta[i] != 0,
                           out[7][i]});
    return samples;
}

std::vector<std::array<double, 2>> DeviceBsdf::invert_in_double(const Direction& wo,
                                                                const std::vector<Direction>& wi) const
{
    std::vector<DeviceArgument> arguments =
        material_arguments<double>({bsdf_}, std::vector<uint>(wi.size(), 0), std::vector<Direction>(wi.size(), wo));
    append_components(arguments, wi);
    const DeviceResults results = functions_in_double().evaluate(device_, "invert", arguments);
    std::vector<std::array<double, 2>> numbers(wi.size());
    for (std::size_t k = 0; k < 2; ++k) {
        const std::vector<float> high = results.get<float>(2 * k), low = results.get<float>(2 * k + 1);
        for (std::size_t i = 0; i < wi.size(); ++i) numbers[i][k] = double{high[i]} + low[i];
    }
    return numbers;
}

std::vector<std::vector<std::uint32_t>> sample_and_evaluate(const Device& device, const std::vector<BsdfCase>& cases,
                                                            const std::vector<uint>& which,
                                                            const std::vector<Direction>& wo,
                                                            const std::vector<Direction>& wi,
                                                            const std::vector<RandomWords>& random, std::uint32_t lanes)
{
    std::vector<DeviceArgument> sampling = material_arguments<float>(cases, which, wo), evaluation = sampling;
    append_components(sampling, random);
    append_components(evaluation, wi);
    auto outputs = functions().evaluate(device, "sample", sampling, lanes).outputs;
    const auto more = functions().evaluate(device, "evaluate", evaluation, lanes).outputs;
    outputs.insert(outputs.end(), more.begin(), more.end());
    return outputs;
}
} // namespace etendue
