// Fits against closed forms and planted curves.
#include "converge/fit.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;

namespace
{
std::vector<double> powers_of_two(int count)
{
    std::vector<double> x;
    for (int i = 0; i < count; ++i) x.push_back(std::exp2(i));
    return x;
}

std::vector<double> law(const std::vector<double>& x, double a, double p, double b)
{
    std::vector<double> y;
    for (const double n : x) y.push_back(a * std::pow(n, -p) + b);
    return y;
}
} // namespace

TEST_CASE("a line by least squares is that of the textbook", "[converge]")
{
    const LineFit fit = fit_line({1, 2, 3, 4}, {6, 5, 7, 10});
    CHECK(fit.slope == Approx(1.4));
    CHECK(fit.intercept == Approx(3.5));
    CHECK(std::isnan(fit_line({2, 2}, {1, 5}).slope));
    CHECK(std::isnan(fit_line({2}, {1}).slope));
}

TEST_CASE("a power law is a line in log-log, and what is not positive is left out", "[converge]")
{
    const std::vector<double> x = powers_of_two(11);
    CHECK(log_log_slope(x, law(x, 3.0, 1.5, 0.0)) == Approx(-1.5));
    CHECK(log_log_slope({1, 2, 0, 4}, {8, 4, 5, 2}) == Approx(-1.0));
    CHECK(log_log_slope({1, 2, 4}, {8, 4, -1}) == Approx(-1.0));
}

TEST_CASE("the fit with a floor finds planted curves", "[converge]")
{
    const std::vector<double> x = powers_of_two(11);
    for (const double b : {0.0, 1e-4, -1e-4, 0.1}) {
        CAPTURE(b);
        const FloorFit fit = fit_floor(x, law(x, 0.5, 1.0, b));
        CHECK(fit.a == Approx(0.5));
        CHECK(fit.b == Approx(b).margin(1e-12));
    }
    CHECK(std::isnan(fit_floor({1, 2}, {2, 1}).b));
    CHECK(std::isnan(fit_floor({}, {}).b));
}

TEST_CASE("errors that fall faster than 1 / x, first or to the end, have no floor above zero", "[converge]")
{
    const std::vector<double> x = powers_of_two(11);
    CHECK(fit_floor(x, law(x, 0.5, 1.5, 0.0)).b < 0.0);
    // x^-3 + x^-1 / 30: steep, then 1 / x.
    std::vector<double> bent;
    for (const double n : x) bent.push_back(std::pow(n, -3.0) + 1.0 / (30.0 * n));
    CHECK(fit_floor(x, bent).b < 1e-3 * bent.back());
    // Errors measured in a scene under a sky with Owen-scrambled Sobol points, 1 to 1024 samples.
    const std::vector<double> measured{0.0310073,   0.0105427,   0.00456027,  0.00191551,  0.000845462, 0.000397083,
                                       0.000191231, 9.59039e-05, 4.47224e-05, 2.26086e-05, 1.12654e-05};
    CHECK(fit_floor(x, measured).b < 0.0);
}

TEST_CASE("without a floor the fitted one scatters around zero", "[converge]")
{
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    const std::vector<double> x = powers_of_two(11);
    double sum = 0.0, squares = 0.0;
    const int trials = 400;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> y = law(x, 1.0, 1.0, 0.0);
        for (double& value : y) value *= 1.0 + 0.01 * normal(random);
        const double b = fit_floor(x, y).b;
        sum += b / trials;
        squares += b * b / trials;
    }
    // Much below the last error, 1 / 1024, and no drift beyond its own standard error.
    CHECK(std::sqrt(squares) < 0.1 / 1024);
    CHECK(std::abs(sum) < 4.5 * std::sqrt(squares / trials));
}

TEST_CASE("a curve crosses a target where its line in log-log does", "[converge]")
{
    const std::vector<double> x = powers_of_two(5), y = law(x, 1.0, 1.0, 0.0);
    const Crossing crossing = find_crossing(x, y, 0.1);
    CHECK(crossing.kind == Crossing::Kind::at);
    CHECK(crossing.x == Approx(10.0));
    CHECK(find_crossing(x, y, 0.125).x == Approx(8.0));
    CHECK(find_crossing(x, y, 2.0).kind == Crossing::Kind::before_first);
    CHECK(find_crossing(x, y, 0.01).kind == Crossing::Kind::not_reached);
    CHECK(find_crossing({}, {}, 0.01).kind == Crossing::Kind::not_reached);
}
