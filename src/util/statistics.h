// Statistics of samples, and the distributions that tests and error bars need. Everything in double.
#pragma once

#include <cstddef>
#include <vector>

namespace etendue
{
// Mean and sum of squared deviations from it, of some number of values that is kept elsewhere.
struct Moments {
    double mean = 0.0;
    double m2 = 0.0;
};

// The moments of two sets together (Chan, Golub, LeVeque 1979, eq. 2.1). Counts may be 0.
Moments merge_moments(const Moments& a, double count_a, const Moments& b, double count_b);

// Mean and variance of values that come one by one (Welford 1962).
class RunningStatistics
{
public:
    void add(double value);

    std::size_t count() const { return count_; }
    double mean() const { return moments_.mean; }
    // Unbiased; infinite for fewer than two values, of which nothing is known.
    double variance() const;
    // Standard deviation of the mean.
    double standard_error() const;

private:
    std::size_t count_ = 0;
    Moments moments_;
};

// P(Z <= z) for a standard normal, and its inverse for 0 < p < 1.
double normal_cdf(double z);
double normal_quantile(double p);

// P(T <= t) for Student's t with `degrees` > 0 degrees of freedom, and its inverse for 0 < p < 1.
double student_t_cdf(double t, double degrees);
double student_t_quantile(double p, double degrees);

// Student's t of a mean whose noise has this skewness, as if it had none, where that makes it smaller: the mean and its
// error are not independent then, and t has one long tail. Hall: On the Removal of Skewness by Transformation, JRSS B
// 54 (1992). Of sums of rare values |t| > 4 comes 40 times as often as for normal ones at skewness 0.2, and with this
// not more often; from 0.4 on it means nothing (measured). At LARGEST_SKEWNESS it takes |t| = 8 to be as good as 5.
constexpr double LARGEST_SKEWNESS = 0.15;
double without_skewness(double t, double skewness_of_mean);
// The |t| that is `symmetric` > 0 without the skewness, on the side where it takes more.
double with_skewness(double symmetric, double skewness_of_mean);

// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0 (DLMF 8.2.4).
double gamma_q(double a, double x);
// Regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1 (DLMF 8.17.2).
double beta_i(double a, double b, double x);

// P(chi^2 >= statistic) with `degrees` degrees of freedom.
double chi_square_p_value(double statistic, double degrees);

// The level of each of `tests` independent tests whose family has level `family_alpha` (Sidak 1967).
double sidak_alpha(double family_alpha, std::size_t tests);

// Kolmogorov and Smirnov's test that values are uniform on [0, 1]: P(a largest distance between the empirical and the
// uniform distribution function as far as this one or farther), by the limit distribution with Stephens' (1970)
// correction for small samples. At least 5 values.
double ks_uniform_p_value(std::vector<double> values);

// The same against too many small values only: P(the empirical distribution function above the uniform one by as much
// somewhere, or more). Smirnov's (1944) limit exp(-2 n d^2), with Stephens' correction.
double ks_small_p_value(std::vector<double> values);
} // namespace etendue
