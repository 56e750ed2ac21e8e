// The errors of one run at its checkpoints: the rows of errors.csv.
#pragma once

#include "converge/measurement.h"
#include "converge/reference.h"
#include "image/metrics.h"

#include <cstdint>
#include <vector>

namespace etendue
{
struct ErrorRow {
    std::size_t checkpoint = 0; // its number, by which the rows of different runs belong together
    std::uint64_t samples = 0;  // per pixel
    double render_seconds = 0.0, kernel_seconds = 0.0;
    std::uint64_t rays = 0;
    Metrics metrics;         // as measured, with the reference's own variance in them
    double mse = 0.0;        // without it
    double relmse = 0.0;     // without it
    double film_error = 0.0; // the relative error as the film estimates it, without looking at a reference
    double var_mean = 0.0;   // variance of the picture's mean, as the film estimates it
    BadValues bad;
    std::uint64_t accidents = 0;
};

struct Run {
    std::uint64_t seed = 0;
    std::vector<ErrorRow> rows;
    std::string replay;         // the command that replays the first accident; "" without any
    Vec3 picture_mean{0.0};     // at the last row
    Vec3 picture_variance{0.0}; // of that mean, as the film estimates it
    Measurement measurement;
};

// What relMSE divides by, from the reference: r^2 + (epsilon * mean r)^2.
struct RelativeScale {
    RelativeScale(const Pixels& reference, const MetricSettings& settings);
    double operator()(double r) const { return r * r + floor; }
    double floor = 0.0;
};

// Mean over pixels and channels of the reference's variance over its relative scale.
double relative_floor(const Reference& reference, const MetricSettings& settings);

// The variance of the mean of all pixels, from those of independent pixels.
Vec3 variance_of_picture_mean(const Pixels& variance);

// The row of a snapshot; `relative` is relative_floor(reference).
ErrorRow error_row(const Snapshot& snapshot, const Reference& reference, double relative,
                   const MetricSettings& settings);

// A snapshot without a reference: the errors are still to come.
ErrorRow bare_row(const Snapshot& snapshot);

// For runs without a reference: the errors of each picture against the mean of all, times S / (S - 1), whose
// expectation is the variance. pictures[run][checkpoint]; runs that ended early count as far as they went. Sees no
// bias.
void set_errors_between_seeds(std::vector<Run>& runs, const std::vector<std::vector<Pixels>>& pictures,
                              const MetricSettings& settings);
} // namespace etendue
