// Pixel filters: where their samples lie, and the moments of each.
#include "support/device_lanes.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <string>

using namespace etendue;

namespace
{
const DeviceFunctions functions({"sampling/filter.h"},
                                {{"offset", "RenderSettings* float float -> float float",
                                  "Vec2 p = filter_sample(in0, in1, in2); out0 = p.x; out1 = p.y;"}});

struct Filter {
    std::string name;
    RenderSettings settings;
    double radius;
    double variance; // of each axis, in closed form
    bool round;
};

Filter make_filter(const std::string& name, uint type, double radius, double sigma, double variance)
{
    Filter filter{name, {}, radius, variance, type == FILTER_GAUSSIAN};
    filter.settings.filter = type;
    filter.settings.filter_parameters =
        make_real4(radius, sigma, -std::expm1(-0.5 * radius * radius / (sigma * sigma)));
    return filter;
}

// Variance of an axis of a round Gaussian cut off at a radius: with q = r^2 / (2 sigma^2), E[x^2] = E[r^2] / 2 =
// sigma^2 (1 - q exp(-q) / (1 - exp(-q))).
double truncated_gaussian_variance(double radius, double sigma)
{
    const double q = 0.5 * radius * radius / (sigma * sigma);
    return sigma * sigma * (1.0 - q * std::exp(-q) / -std::expm1(-q));
}

// A box is uniform: radius^2 / 3. A tent is the sum of two boxes of half its radius: radius^2 / 6.
std::vector<Filter> filters()
{
    return {make_filter("box", FILTER_BOX, 0.5, 1.0, 0.25 / 3.0),
            make_filter("wide box", FILTER_BOX, 2.0, 1.0, 4.0 / 3.0),
            make_filter("tent", FILTER_TENT, 1.0, 1.0, 1.0 / 6.0),
            make_filter("wide tent", FILTER_TENT, 1.5, 1.0, 2.25 / 6.0),
            make_filter("gaussian", FILTER_GAUSSIAN, 1.5, 0.5, truncated_gaussian_variance(1.5, 0.5)),
            make_filter("blunt gaussian", FILTER_GAUSSIAN, 1.0, 2.0, truncated_gaussian_variance(1.0, 2.0))};
}

std::vector<float> uniform_floats(unsigned seed)
{
    std::mt19937 engine(seed);
    std::vector<float> values(1 << 16);
    for (float& value : values) value = static_cast<float>(engine() >> 8) * 0x1p-24f;
    return values;
}
} // namespace

TEST_CASE("filter samples lie within the radius, have mean 0 and the filter's variance on both axes")
{
    std::vector<float> u = uniform_floats(1), v = uniform_floats(2);
    for (Device& device : test_devices())
        for (const Filter& filter : filters()) {
            const DeviceResults out =
                functions.evaluate(device, "offset", {std::vector<RenderSettings>{filter.settings}, u, v});
            const std::vector<float> axes[] = {out.get<float>(0), out.get<float>(1)};
            INFO(filter.name);
            RunningStatistics product;
            for (const auto& axis : axes) {
                RunningStatistics offsets, squares;
                for (const float x : axis) {
                    offsets.add(x);
                    squares.add(double{x} * x);
                }
                CHECK(std::fabs(offsets.mean()) <= 5.0 * offsets.standard_error());
                CHECK(std::fabs(squares.mean() - filter.variance) <= 5.0 * squares.standard_error());
            }
            for (std::size_t i = 0; i < u.size(); ++i) product.add(double{axes[0][i]} * axes[1][i]);
            CHECK(std::fabs(product.mean()) <= 5.0 * product.standard_error());
        }
}

TEST_CASE("filter samples from the ends of the unit square stay within the radius")
{
    std::vector<float> u = uniform_floats(3), v = uniform_floats(4);
    const float ends[] = {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1.0f - 0x1p-24f};
    for (const float a : ends)
        for (const float b : ends) u.push_back(a), v.push_back(b);
    for (Device& device : test_devices())
        for (const Filter& filter : filters()) {
            const DeviceResults out =
                functions.evaluate(device, "offset", {std::vector<RenderSettings>{filter.settings}, u, v});
            const auto x = out.get<float>(0), y = out.get<float>(1);
            std::size_t outside = 0;
            for (std::size_t i = 0; i < u.size(); ++i) {
                const double distance = filter.round ? std::hypot(double{x[i]}, double{y[i]})
                                                     : std::fmax(std::fabs(double{x[i]}), std::fabs(double{y[i]}));
                outside += !(distance <= filter.radius * (1.0 + (filter.round ? 4e-7 : 0.0)));
            }
            INFO(filter.name);
            CHECK(outside == 0);
        }
}

TEST_CASE("filter samples have the same bits at every number of lanes")
{
    const std::vector<float> u = uniform_floats(5), v = uniform_floats(6);
    for (Device& device : test_devices())
        for (const Filter& filter : filters())
            evaluate_in_all_lanes(functions, device, "offset", {std::vector<RenderSettings>{filter.settings}, u, v});
}
