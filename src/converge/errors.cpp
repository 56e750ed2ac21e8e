// Metrics against a reference, and between seeds.
#include "converge/errors.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
Vec3 variance_of_picture_mean(const Pixels& variance)
{
    return mean_of(variance) / static_cast<double>(variance.size());
}

RelativeScale::RelativeScale(const Pixels& reference, const MetricSettings& settings)
{
    const Vec3 mean = mean_of(reference);
    const double epsilon = settings.relative_epsilon * (mean.x + mean.y + mean.z) / 3.0;
    floor = epsilon * epsilon;
}

double relative_floor(const Reference& reference, const MetricSettings& settings)
{
    if (reference.kind == Reference::Kind::none) return 0.0;
    const RelativeScale scale(reference.mean, settings);
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.mean.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (reference.variance[i][c] > 0.0) sum += reference.variance[i][c] / scale(reference.mean[i][c]);
    return sum / (3.0 * static_cast<double>(reference.mean.size()));
}

ErrorRow bare_row(const Snapshot& snapshot)
{
    ErrorRow row;
    row.checkpoint = snapshot.checkpoint;
    row.samples = snapshot.samples;
    row.render_seconds = snapshot.render_seconds;
    row.kernel_seconds = snapshot.kernel_seconds;
    row.rays = snapshot.rays;
    row.film_error = snapshot.relative_error;
    const Vec3 of_mean = variance_of_picture_mean(snapshot.pixels.variance);
    row.var_mean = (of_mean.x + of_mean.y + of_mean.z) / 3.0;
    row.bad = count_bad_values(snapshot.pixels.mean);
    row.accidents = snapshot.accidents;
    return row;
}

ErrorRow error_row(const Snapshot& snapshot, const Reference& reference, double relative,
                   const MetricSettings& settings)
{
    ErrorRow row = bare_row(snapshot);
    row.metrics = compare_pictures(snapshot.pixels.mean, reference.mean, settings);
    row.mse = row.metrics.mse - reference.floor;
    row.relmse = row.metrics.relmse - relative;
    return row;
}

void set_errors_between_seeds(std::vector<Run>& runs, const std::vector<std::vector<Pixels>>& pictures,
                              const MetricSettings& settings)
{
    std::size_t checkpoints = 0;
    for (const Run& run : runs)
        for (const ErrorRow& row : run.rows) checkpoints = std::max(checkpoints, row.checkpoint + 1);
    for (std::size_t checkpoint = 0; checkpoint < checkpoints; ++checkpoint) {
        PixelPool pool;
        for (std::size_t r = 0; r < runs.size(); ++r)
            for (std::size_t k = 0; k < runs[r].rows.size(); ++k)
                if (runs[r].rows[k].checkpoint == checkpoint) pool.add(pictures[r][k]);
        const Pixels mean = pool.mean();
        const double n = static_cast<double>(pool.count());
        const double unbiased = n > 1 ? n / (n - 1) : std::nan("");
        for (std::size_t r = 0; r < runs.size(); ++r)
            for (std::size_t k = 0; k < runs[r].rows.size(); ++k) {
                ErrorRow& row = runs[r].rows[k];
                if (row.checkpoint != checkpoint) continue;
                row.metrics = compare_pictures(pictures[r][k], mean, settings);
                row.metrics.mse *= unbiased;
                row.metrics.relmse *= unbiased;
                row.mse = row.metrics.mse;
                row.relmse = row.metrics.relmse;
            }
    }
}
} // namespace etendue
