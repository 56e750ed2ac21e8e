// Distributions against published tables and closed forms; moments against long double sums.
#include "util/statistics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace etendue;

TEST_CASE("running mean and variance survive a large offset")
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(1e6, 1e6 + 1);
    std::vector<double> values(10000);
    RunningStatistics statistics;
    for (double& value : values) statistics.add(value = uniform(random));

    long double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    const long double mean = sum / values.size();
    for (const double value : values) squares += (value - mean) * (value - mean);
    const auto variance = static_cast<double>(squares / (values.size() - 1));
    CHECK(statistics.count() == values.size());
    CHECK(statistics.mean() == Approx(static_cast<double>(mean)).epsilon(1e-15));
    CHECK(statistics.variance() == Approx(variance).epsilon(1e-9));
    CHECK(statistics.standard_error() == Approx(std::sqrt(variance / 10000)).epsilon(1e-9));
}

TEST_CASE("the variance of one value is unknown, not zero")
{
    RunningStatistics statistics;
    statistics.add(3.0);
    CHECK(std::isinf(statistics.variance()));
    CHECK(std::isinf(statistics.standard_error()));
}

TEST_CASE("merged moments are those of all values together")
{
    const Moments left{2.0, 2.0};  // 1 2 3
    const Moments right{7.0, 8.0}; // 5 9
    const Moments both = merge_moments(left, 3, right, 2);
    CHECK(both.mean == Approx(4.0)); // 1 2 3 5 9
    CHECK(both.m2 == Approx(40.0));
    const Moments same = merge_moments({}, 0, right, 2);
    CHECK(same.mean == right.mean);
    CHECK(same.m2 == right.m2);
    CHECK(merge_moments({}, 0, {}, 0).mean == 0.0);
}

TEST_CASE("normal quantiles are those of the tables")
{
    CHECK(normal_quantile(0.5) == Approx(0.0).margin(1e-15));
    CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-13));
    CHECK(normal_quantile(0.995) == Approx(2.575829303548901).epsilon(1e-13));
    CHECK(normal_quantile(1e-10) == Approx(-6.361340902404056).epsilon(1e-13));
    CHECK(normal_cdf(-1.0) == Approx(0.15865525393145705).epsilon(1e-14));
}

TEST_CASE("Student's t agrees with its closed forms and tables")
{
    // One degree of freedom is Cauchy's distribution, two have an algebraic distribution function.
    for (const double t : {-30.0, -2.0, -0.1, 0.0, 0.5, 1.0, 4.0}) {
        CHECK(student_t_cdf(t, 1) == Approx(0.5 + std::atan(t) / std::numbers::pi).epsilon(1e-12));
        CHECK(student_t_cdf(t, 2) == Approx(0.5 + t / (2 * std::sqrt(2 + t * t))).epsilon(1e-12));
    }
    CHECK(student_t_quantile(0.975, 15) == Approx(2.131449545559323).epsilon(1e-12));
    CHECK(student_t_quantile(0.95, 30) == Approx(1.697260886593957).epsilon(1e-12));
    CHECK(student_t_quantile(0.0005, 5) == Approx(-6.868826625881382).epsilon(1e-11));
    CHECK(student_t_quantile(0.975, 1e7) == Approx(1.959963984540054).epsilon(1e-6));
}

TEST_CASE("chi-square p-values agree with their closed forms and tables")
{
    // Two degrees of freedom: exp(-x/2). Four: (1 + x/2) exp(-x/2). One: erfc(sqrt(x/2)).
    for (const double x : {0.01, 0.5, 2.0, 7.0, 60.0}) {
        CHECK(chi_square_p_value(x, 1) == Approx(std::erfc(std::sqrt(x / 2))).epsilon(1e-12));
        CHECK(chi_square_p_value(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-12));
        CHECK(chi_square_p_value(x, 4) == Approx((1 + x / 2) * std::exp(-x / 2)).epsilon(1e-12));
    }
    CHECK(chi_square_p_value(124.342113, 100) == Approx(0.05).epsilon(1e-6));
    CHECK(chi_square_p_value(0.0, 7) == 1.0);
    // Wilson and Hilferty's cube root for many degrees of freedom.
    const double n = 8191, x = 8500, z = (std::cbrt(x / n) - (1 - 2 / (9 * n))) / std::sqrt(2 / (9 * n));
    CHECK(chi_square_p_value(x, n) == Approx(normal_cdf(-z)).epsilon(1e-3));
}

TEST_CASE("the incomplete beta function agrees with binomial sums")
{
    // I_x(a, b) for integers is P(at least a of a + b - 1 trials succeed).
    const double x = 0.3;
    double sum = 0.0;
    for (int k = 3; k <= 7; ++k)
        sum += std::tgamma(8) / (std::tgamma(k + 1) * std::tgamma(8 - k)) * std::pow(x, k) * std::pow(1 - x, 7 - k);
    CHECK(beta_i(3, 5, x) == Approx(sum).epsilon(1e-13));
    CHECK(beta_i(3, 5, 0.9) == Approx(1 - beta_i(5, 3, 0.1)).epsilon(1e-13));
}

TEST_CASE("Sidak's level gives the family its level")
{
    const double alpha = sidak_alpha(1e-3, 500);
    CHECK(1 - std::pow(1 - alpha, 500) == Approx(1e-3).epsilon(1e-9));
    CHECK(sidak_alpha(0.05, 1) == Approx(0.05).epsilon(1e-15));
}

TEST_CASE("the uniformity test accepts uniform values and refuses a bent distribution")
{
    // A set whose largest distance is known: critical value 1.3581 / (sqrt n + 0.12 + 0.11 / sqrt n) at 5 %.
    const std::size_t n = 100;
    const double root = std::sqrt(static_cast<double>(n)), distance = 1.3581 / (root + 0.12 + 0.11 / root);
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i)
        values[i] = std::max(0.0, (static_cast<double>(i) + 1) / static_cast<double>(n) - distance);
    CHECK(ks_uniform_p_value(values) == Approx(0.05).epsilon(2e-3));

    // Both of Kolmogorov's series agree where one takes over from the other.
    const double below = 0.999999 / (root + 0.12 + 0.11 / root), above = 1.000001 / (root + 0.12 + 0.11 / root);
    for (const double d : {below, above}) {
        for (std::size_t i = 0; i < n; ++i)
            values[i] = std::max(0.0, (static_cast<double>(i) + 1) / static_cast<double>(n) - d);
        CHECK(ks_uniform_p_value(values) == Approx(0.26999967).epsilon(1e-4));
    }

    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    RunningStatistics p_values;
    std::vector<double> sample(200);
    for (int run = 0; run < 2000; ++run) {
        for (double& value : sample) value = uniform(random);
        p_values.add(ks_uniform_p_value(sample));
    }
    CHECK(std::abs(p_values.mean() - 0.5) < 5 * p_values.standard_error());
    for (double& value : sample) value = uniform(random) * uniform(random);
    CHECK(ks_uniform_p_value(sample) < 1e-6);
}

TEST_CASE("too many small values are found, too many large ones are none of it")
{
    // P(D+ > d) = exp(-2 n d^2) for many values; here the distance is set to one where that is 1 %.
    const std::size_t n = 10000;
    const double root = std::sqrt(static_cast<double>(n));
    const double distance = std::sqrt(-std::log(0.01) / 2) / (root + 0.12 + 0.11 / root);
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i)
        values[i] = std::max(0.0, (static_cast<double>(i) + 1) / static_cast<double>(n) - distance);
    CHECK(ks_small_p_value(values) == Approx(0.01).epsilon(2e-3));
    for (double& value : values) value = 1.0 - value;
    CHECK(ks_small_p_value(values) > 0.99);

    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    RunningStatistics p_values;
    std::vector<double> sample(100);
    for (int run = 0; run < 2000; ++run) {
        for (double& value : sample) value = uniform(random);
        p_values.add(ks_small_p_value(sample));
    }
    CHECK(std::abs(p_values.mean() - 0.5) < 5 * p_values.standard_error());
}

TEST_CASE("a mean of skewed values is significant as often as its level says")
{
    // Means of 100 exponential values have skewness 2 / sqrt(100); t has a long tail below.
    constexpr int MEANS = 40000, VALUES = 100;
    constexpr double SKEWNESS = 0.2, LEVEL = 1e-3;
    const double critical = student_t_quantile(1 - LEVEL, VALUES - 1);
    std::mt19937_64 random(3);
    std::exponential_distribution<double> exponential(1.0);
    int plain = 0, corrected = 0;
    for (int i = 0; i < MEANS; ++i) {
        RunningStatistics values;
        for (int k = 0; k < VALUES; ++k) values.add(exponential(random));
        const double t = (values.mean() - 1.0) / values.standard_error();
        plain += t < -critical;
        corrected += without_skewness(t, SKEWNESS) < -critical;
    }
    CAPTURE(plain, corrected);
    // 40 are expected with a standard deviation of 6.3.
    CHECK(plain > 4 * MEANS * LEVEL);
    CHECK(corrected < 1.8 * MEANS * LEVEL);
}

TEST_CASE("skewness makes nothing more significant, and none changes nothing")
{
    for (const double t : {-30.0, -4.5, -1.0, 0.0, 0.2, 3.0, 12.0}) {
        CHECK(without_skewness(t, 0.0) == t);
        for (const double skewness : {-1.0, -0.1, 0.1, 1.0}) {
            CAPTURE(t, skewness);
            CHECK(std::abs(without_skewness(t, skewness)) <= std::abs(t));
            CHECK(without_skewness(-t, -skewness) == -without_skewness(t, skewness));
        }
    }
    CHECK(std::abs(without_skewness(-5.0, 0.3)) < 4.0);
    CHECK(without_skewness(5.0, 0.3) == 5.0);
}

TEST_CASE("what skewness takes from t is what it takes more")
{
    for (const double skewness : {-LARGEST_SKEWNESS, -0.05, 0.0, 0.01, 0.1, LARGEST_SKEWNESS})
        for (const double symmetric : {0.5, 2.0, 3.9, 5.0, 6.0}) {
            CAPTURE(skewness, symmetric);
            const double t = with_skewness(symmetric, skewness);
            CHECK(t >= symmetric);
            CHECK(std::abs(without_skewness(skewness > 0.0 ? -t : t, skewness)) == Approx(symmetric));
        }
    CHECK(with_skewness(5.0, LARGEST_SKEWNESS) > 7.0);
    CHECK(with_skewness(5.0, LARGEST_SKEWNESS) < 8.5);
}
