// The test that every statistical check uses: whether a mean is what it must be, and whether the test could have seen
// that it is not.
#pragma once

#include "check/check.h"
#include "math/rounding.h"

#include <cstdint>

namespace etendue
{
// A mean of which one contribution is more than this share has an error that nobody knows.
inline constexpr double HEAVY_SHARE = 0.05;

struct MeanTest {
    double z = 0.0; // the difference beyond the roundings in standard errors; infinite: no variance, and a difference
    double p_value = 1.0;         // two-sided, by Student's t
    double critical = 0.0;        // of |z|
    double detectable_bias = 0.0; // the relative bias that is seen with 99 % probability
    bool underpowered = false;    // that is more than delta
    bool heavy_tail = false;      // there is variance, and the largest contribution is more than HEAVY_SHARE
};

// The |t| that a test at this two-sided level does not exceed by chance.
double critical_value(double test_alpha, double degrees);

// Test a mean with the given standard error and degrees of freedom. Nothing assumes a least variance: without any, the
// mean must be the expected one within `roundings`.
MeanTest test_mean(double mean, double standard_error, double degrees, double expected, const CheckContext& context,
                   double largest_share = 0.0, double roundings = MEAN_ROUNDINGS);

// Fill in what the test says: statistic, limit, detectable bias, verdict and, where it is bad, a note.
void judge(CheckResult& result, const MeanTest& test, const CheckContext& context);
} // namespace etendue
