// The special functions are summed from their series and continued fractions (DLMF), quantiles found by bisection.
#include "util/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace etendue
{
namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double tiny = std::numeric_limits<double>::min() / epsilon;
constexpr int max_terms = 100000;

double not_zero(double x)
{
    return std::abs(x) < tiny ? tiny : x;
}

// b_0 + a_1/(b_1 + a_2/(b_2 + ...)) by the modified Lentz algorithm (Thompson, Barnett 1986).
template<typename Numerator, typename Denominator>
double continued_fraction(Numerator a, Denominator b)
{
    double f = not_zero(b(0)), c = f, d = 0.0;
    for (int i = 1; i < max_terms; ++i) {
        d = 1.0 / not_zero(b(i) + a(i) * d);
        c = not_zero(b(i) + a(i) / c);
        f *= c * d;
        if (std::abs(c * d - 1.0) <= epsilon) break;
    }
    return f;
}

// The z >= 0 at which a falling tail probability, 1/2 at 0, is p.
template<typename Tail>
double invert_tail(Tail tail, double p)
{
    double low = 0.0, high = 1.0;
    while (tail(high) > p && high < std::numeric_limits<double>::max() / 2) high *= 2;
    while (true) {
        const double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) return middle;
        (tail(middle) > p ? low : high) = middle;
    }
}

double normal_tail(double z)
{
    return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

// I_x(a, b) by its continued fraction (DLMF 8.17.22 and 8.17.23).
double beta_below_mean(double a, double b, double x)
{
    const double scale =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) / a;
    const auto numerator = [a, b, x](int i) {
        if (i == 1) return 1.0;
        const int m = (i - 1) / 2;
        if (i % 2 == 0) return -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        return m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    };
    return scale * continued_fraction(numerator, [](int i) { return i == 0 ? 0.0 : 1.0; });
}

// P(T > t) for t >= 0 (DLMF 8.17 with x = degrees / (degrees + t^2)).
double student_t_tail(double t, double degrees)
{
    // Of so many degrees it is the normal distribution's, within 1e-7 of itself up to t = 10.
    if (degrees > 1e10) return 0.5 * std::erfc(t / std::numbers::sqrt2);
    return 0.5 * beta_i(degrees / 2, 0.5, degrees / (degrees + t * t));
}

// P(sqrt(n) D > lambda) for large n, by whichever of Kolmogorov's two series converges fast.
double kolmogorov_tail(double lambda)
{
    constexpr double pi = std::numbers::pi;
    double sum = 0.0;
    if (lambda < 1.0) {
        for (int k = 1; k <= 19; k += 2) sum += std::exp(-k * k * pi * pi / (8 * lambda * lambda));
        return 1.0 - std::sqrt(2 * pi) / lambda * sum;
    }
    for (int k = 1; k <= 10; ++k) sum += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * lambda * lambda);
    return sum;
}
} // namespace

Moments merge_moments(const Moments& a, double count_a, const Moments& b, double count_b)
{
    const double count = count_a + count_b;
    if (count == 0.0) return {};
    const double delta = b.mean - a.mean;
    return {a.mean + delta * (count_b / count), a.m2 + b.m2 + delta * delta * (count_a * (count_b / count))};
}

void RunningStatistics::add(double value)
{
    ++count_;
    const double delta = value - moments_.mean;
    moments_.mean += delta / static_cast<double>(count_);
    moments_.m2 += delta * (value - moments_.mean);
}

double RunningStatistics::variance() const
{
    if (count_ < 2) return std::numeric_limits<double>::infinity();
    return moments_.m2 / static_cast<double>(count_ - 1);
}

double RunningStatistics::standard_error() const
{
    if (count_ < 2) return std::numeric_limits<double>::infinity();
    return std::sqrt(variance() / static_cast<double>(count_));
}

double normal_cdf(double z)
{
    return normal_tail(-z);
}

double normal_quantile(double p)
{
    return p < 0.5 ? -invert_tail(normal_tail, p) : invert_tail(normal_tail, 1.0 - p);
}

double student_t_cdf(double t, double degrees)
{
    return t < 0.0 ? student_t_tail(-t, degrees) : 1.0 - student_t_tail(t, degrees);
}

double student_t_quantile(double p, double degrees)
{
    const auto tail = [degrees](double t) { return student_t_tail(t, degrees); };
    return p < 0.5 ? -invert_tail(tail, p) : invert_tail(tail, 1.0 - p);
}

double without_skewness(double t, double skewness_of_mean)
{
    const double a = skewness_of_mean / 3.0;
    const double symmetric = t + a * t * t + a * a * t * t * t / 3.0 + skewness_of_mean / 6.0;
    return std::abs(symmetric) < std::abs(t) ? symmetric : t;
}

double with_skewness(double symmetric, double skewness_of_mean)
{
    const double s = std::abs(skewness_of_mean), a = s / 3.0;
    if (s == 0.0) return symmetric;
    // Hall's cubic is ((1 + a t)^3 - 1) / (3 a) + s / 6.
    const double t = (std::cbrt(1.0 - 3.0 * a * (symmetric + s / 6.0)) - 1.0) / a;
    return std::max(symmetric, -t);
}

double gamma_q(double a, double x)
{
    if (x <= 0.0) return 1.0;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        // 1 - P by its power series (DLMF 8.7.1).
        double term = 1.0 / a, sum = term;
        for (int n = 1; n < max_terms && term > sum * epsilon; ++n) {
            term *= x / (a + n);
            sum += term;
        }
        return 1.0 - scale * sum;
    }
    // Q by its continued fraction (DLMF 8.9.2, even part).
    return scale / continued_fraction([a](int i) { return -i * (i - a); }, [a, x](int i) { return x + 2 * i + 1 - a; });
}

double beta_i(double a, double b, double x)
{
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    // The continued fraction converges fast below the mean; above it use the symmetry (DLMF 8.17.4).
    return x > (a + 1) / (a + b + 2) ? 1.0 - beta_below_mean(b, a, 1.0 - x) : beta_below_mean(a, b, x);
}

double chi_square_p_value(double statistic, double degrees)
{
    return gamma_q(degrees / 2, statistic / 2);
}

double sidak_alpha(double family_alpha, std::size_t tests)
{
    return -std::expm1(std::log1p(-family_alpha) / static_cast<double>(tests));
}

double ks_uniform_p_value(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const double n = static_cast<double>(values.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double below = static_cast<double>(i) / n, above = static_cast<double>(i + 1) / n;
        distance = std::max({distance, values[i] - below, above - values[i]});
    }
    return kolmogorov_tail((std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance);
}

double ks_small_p_value(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const double n = static_cast<double>(values.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        distance = std::max(distance, static_cast<double>(i + 1) / n - values[i]);
    const double scaled = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
    return std::exp(-2.0 * scaled * scaled);
}
} // namespace etendue
