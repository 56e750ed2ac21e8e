// Intervals: closed forms, and how often they hold what they should.
#include "converge/interval.h"

#include "util/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;

TEST_CASE("Student's interval of four numbers is that of the textbook", "[converge]")
{
    // Mean 5, standard deviation sqrt(20 / 3), t_3(0.975) = 3.182446.
    const Interval interval = mean_interval({2, 4, 6, 8});
    CHECK(interval.estimate == 5.0);
    CHECK(interval.high - 5.0 == Approx(3.182446 * std::sqrt(20.0 / 3.0) / 2.0));
    CHECK(5.0 - interval.low == Approx(interval.high - 5.0));
    CHECK(mean_interval({3.0}).contains(1e300));
    CHECK_FALSE(mean_interval({}).known());
}

TEST_CASE("bootstrap draws are the same every time, within range, and even", "[converge]")
{
    const std::vector<Draw> draws = bootstrap_draws(5, 4000);
    CHECK(draws == bootstrap_draws(5, 4000));
    CHECK(draws != bootstrap_draws(5, 4000, 2));
    std::vector<double> counts(5, 0.0);
    for (const Draw& draw : draws) {
        REQUIRE(draw.size() == 5);
        for (const std::size_t index : draw) counts.at(index) += 1.0;
    }
    double chi_square = 0.0;
    for (const double count : counts) chi_square += (count - 4000.0) * (count - 4000.0) / 4000.0;
    CHECK(chi_square_p_value(chi_square, 4) > 1e-4);
}

TEST_CASE("the bootstrap of a mean has the spread that the mean has", "[converge]")
{
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::vector<double> values(200);
    for (double& value : values) value = 10.0 + normal(random);
    const auto mean = [&](const Draw& draw) {
        double sum = 0.0;
        for (const std::size_t i : draw) sum += values[i];
        return sum / static_cast<double>(draw.size());
    };
    const Interval interval = bootstrap_ratio_interval(mean, bootstrap_draws(200, 2000));
    const Interval student = mean_interval(values);
    CHECK(interval.estimate == Approx(student.estimate));
    CHECK(interval.high - interval.low == Approx(student.high - student.low).epsilon(0.1));
}

TEST_CASE("an interval of ratios of eight seeds holds the truth as often as it says", "[converge]")
{
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    const std::vector<Draw> draws = bootstrap_draws(8, 200);
    int held = 0;
    const int trials = 1000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> a(8), b(8);
        for (std::size_t i = 0; i < 8; ++i) {
            a[i] = 3.0 * std::exp(0.3 * normal(random));
            b[i] = std::exp(0.3 * normal(random));
        }
        const auto ratio = [&](const Draw& draw) {
            double over = 0.0, under = 0.0;
            for (const std::size_t i : draw) {
                over += a[i];
                under += b[i];
            }
            return over / under;
        };
        held += bootstrap_ratio_interval(ratio, draws).contains(3.0);
    }
    // Binomial: 95 % within 4.5 standard deviations; percentiles hold about 89 %.
    CHECK(held > 950 - 31);
    CHECK(held < 950 + 31);
}

TEST_CASE("values that a draw does not have widen the bootstrap's interval", "[converge]")
{
    const std::vector<Draw> draws = bootstrap_draws(4, 1000);
    const auto sometimes = [](const Draw& d) { return d[1] == 0 ? std::nan("") : 1.0 + double(d[0]); };
    CHECK(std::isfinite(bootstrap_ratio_interval(sometimes, draws, 0.25).high));
    CHECK(std::isinf(bootstrap_ratio_interval(sometimes, draws, 0.95).high));
    CHECK(std::isinf(bootstrap_ratio_interval([](const Draw&) { return 1.0; }, bootstrap_draws(1, 100)).high));
}

TEST_CASE("Student's interval by bootstrap holds the mean of eight as often as it says", "[converge]")
{
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    const std::vector<Draw> draws = bootstrap_draws(8, 200);
    int missed = 0;
    const int trials = 2000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> values(8), means;
        for (double& value : values) value = normal(random);
        for (const Draw& draw : draws) {
            double sum = 0.0;
            for (const std::size_t i : draw) sum += values[i] / 8.0;
            means.push_back(sum);
        }
        missed += !bootstrap_t_interval(mean_of(values), means, 8, 0.95).contains(0.0);
    }
    // 5 % of 2000 within four standard deviations, and a little for the 200 draws.
    CHECK(missed > 60);
    CHECK(missed < 150);
}

TEST_CASE("an error that all replicates share widens the interval", "[converge]")
{
    const std::vector<double> same(100, 2.0);
    const Interval interval = bootstrap_t_interval(2.0, same, 8, 0.95, 0.5);
    CHECK(interval.high - 2.0 == Approx(0.5 * student_t_quantile(0.975, 7)));
    CHECK_FALSE(bootstrap_t_interval(std::nan(""), same, 8, 0.95).known());
    CHECK(std::isinf(bootstrap_t_interval(2.0, same, 1, 0.95).high));
}

TEST_CASE("quantiles lie between the values", "[converge]")
{
    CHECK(quantile({3, 1, 2}, 0.5) == 2.0);
    CHECK(quantile({1, 2}, 0.25) == 1.25);
    CHECK(quantile({7}, 0.9) == 7.0);
    CHECK(std::isnan(quantile({}, 0.5)));
}
