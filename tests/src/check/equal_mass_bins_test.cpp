// Bins against lobes whose distribution is known in closed form, broad and narrow.
#include "check/equal_mass_bins.h"

#include "util/chi_square.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using namespace etendue;

namespace
{
constexpr double PI = std::numbers::pi;

// Around the normal on one side: 1 - cosine is exponential with this mean, cut off at 1.
struct Lobe {
    double width, side;

    std::vector<Direction> sample(std::size_t count, unsigned seed) const
    {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(0, 1);
        std::vector<Direction> directions;
        for (std::size_t i = 0; i < count; ++i) {
            const double depth = -width * std::log1p(uniform(random) * std::expm1(-1 / width));
            const double radius = std::sqrt(depth * (2 - depth)), phi = 2 * PI * uniform(random);
            directions.push_back({static_cast<float>(radius * std::cos(phi)),
                                  static_cast<float>(radius * std::sin(phi)), static_cast<float>(side * (1 - depth))});
        }
        return directions;
    }

    std::vector<float> density(const std::vector<Direction>& directions) const
    {
        std::vector<float> values;
        for (const Direction& w : directions) {
            const double x = w[0], y = w[1], z = std::abs(w[2]);
            const double depth = (x * x + y * y) / (1 + z);
            const double value = std::exp(-depth / width) / (-std::expm1(-1 / width) * width * 2 * PI);
            values.push_back(w[2] * side > 0 ? static_cast<float>(value) : 0.0f);
        }
        return values;
    }
};

double p_value(const EqualMassBins& bins, const std::vector<Direction>& samples, const Lobe& lobe)
{
    std::vector<double> counts(bins.count());
    for (const Direction& w : samples) ++counts[bins.bin_of(w)];
    std::vector<double> expected = bins.integrate([&](const auto& wi) { return lobe.density(wi); });
    for (double& e : expected) e *= static_cast<double>(samples.size());
    return chi_square(counts, expected, 0.01).p_value;
}
} // namespace

TEST_CASE("bins hold equal shares of a lobe, however narrow it is", "[host]")
{
    // The share of a bin cut by 256 samples varies by a sixteenth.
    constexpr std::size_t BINS = 512;
    for (const double width : {1.0, 1e-3, 1e-8})
        for (const double side : {1.0, -1.0}) {
            CAPTURE(width, side);
            const Lobe lobe{width, side};
            const EqualMassBins bins(lobe.sample(256 * BINS, 1), BINS);
            CHECK(bins.count() == BINS + 1); // the other side is one
            const std::vector<double> masses = bins.integrate([&](const auto& wi) { return lobe.density(wi); });
            CHECK(std::accumulate(masses.begin(), masses.end(), 0.0) == Approx(1).margin(2e-5));
            CHECK(*std::max_element(masses.begin(), masses.end()) < 1.5 / BINS);
            CHECK(std::count(masses.begin(), masses.end(), 0.0) == 1);
            CHECK(std::count_if(masses.begin(), masses.end(), [](double m) { return m < 0.6 / BINS; }) == 1);
        }
}

TEST_CASE("samples of a lobe fit its density, and no other one", "[host]")
{
    constexpr std::size_t BINS = 512;
    for (const double width : {1.0, 1e-3, 1e-8}) {
        CAPTURE(width);
        const Lobe lobe{width, 1}, wider{1.03 * width, 1};
        const EqualMassBins bins(lobe.sample(256 * BINS, 2), BINS);
        const std::vector<Direction> samples = lobe.sample(1 << 20, 3);
        CHECK(p_value(bins, samples, lobe) > 1e-3);
        if (width < 1) CHECK(p_value(bins, samples, wider) < 1e-6);
    }
}

TEST_CASE("directions that are all one make few bins", "[host]")
{
    for (const Direction& w : {Direction{0, 0, 1}, Direction{0.6f, 0, -0.8f}, Direction{0.3f, 0.4f, 0.866f}}) {
        const EqualMassBins bins(std::vector<Direction>(1000, w), 64);
        CHECK(bins.count() < 10);
        const std::vector<double> masses =
            bins.integrate([](const auto& wi) { return std::vector<float>(wi.size(), static_cast<float>(0.25 / PI)); });
        CHECK(std::accumulate(masses.begin(), masses.end(), 0.0) == Approx(1));
    }
}

TEST_CASE("both sides of the surface have bins by what falls on them", "[host]")
{
    const Lobe up{0.5, 1}, down{1e-4, -1};
    std::vector<Direction> pilot = up.sample(30000, 4);
    const std::vector<Direction> other = down.sample(10000, 5);
    pilot.insert(pilot.end(), other.begin(), other.end());
    const EqualMassBins bins(pilot, 256);
    const auto half_of_both = [&](const std::vector<Direction>& wi) {
        std::vector<float> a = up.density(wi);
        const std::vector<float> b = down.density(wi);
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = 0.75f * a[i] + 0.25f * b[i];
        return a;
    };
    const std::vector<double> masses = bins.integrate(half_of_both);
    CHECK(bins.count() > 150);
    CHECK(std::accumulate(masses.begin(), masses.end(), 0.0) == Approx(1).margin(2e-5));
    // The sign of zero is a side.
    CHECK(bins.bin_of({1, 0, 0.0f}) != bins.bin_of({1, 0, -0.0f}));
}
