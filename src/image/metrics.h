// How far a picture is from its reference, in numbers.
#pragma once

#include "math/vector.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace etendue
{
struct MetricSettings {
    double relative_epsilon = 0.01; // of the reference's mean, kept out of zero by this much where errors are relative
    double trimmed_share = 0.001;   // of the pixels, rounded up to a whole number: the worst, which carry fireflies
};

// Of a picture x against a reference r, both of which count 3 values per pixel. Means are over the values of the pixels
// where both are finite; NaN where there is none. e = relative_epsilon times the mean of the reference, so that what is
// relative stays the same when both pictures are multiplied by a number. 0/0 counts as 0.
struct Metrics {
    double mse = 0.0;          // mean (x - r)^2
    double relmse = 0.0;       // mean (x - r)^2 / (r^2 + e^2)
    double mape = 0.0;         // mean |x - r| / sqrt(r^2 + e^2)
    double max_relative = 0.0; // largest |x - r| / sqrt(r^2 + e^2)
    double mean_error = 0.0;   // mean x - r, signed
    double psnr = 0.0;         // 10 log10(p^2 / mse) in dB, p the largest value of the reference; infinite where equal
    double trimmed_relmse = 0.0; // relmse without the worst pixels: biased, blind to fireflies
    double top_share = 0.0;      // share of the mse that its worst pixels carry
    std::size_t non_finite = 0;  // pixels with a value that is not finite, of either picture
    std::size_t negative = 0;    // pixels of x with a value below 0
    double reference_mean = 0.0; // mean r
};

// Both row by row and equally large; throws std::invalid_argument otherwise.
Metrics compare_pictures(std::span<const Vec3> picture, std::span<const Vec3> reference,
                         const MetricSettings& settings = {});

// A number of Metrics by its name, as tables, files and options call it.
struct MetricName {
    const char* name;       // "relmse"
    const char* label;      // "relMSE", for people
    const char* definition; // one line
    double Metrics::*value;
};
const std::vector<MetricName>& metric_names();
} // namespace etendue
