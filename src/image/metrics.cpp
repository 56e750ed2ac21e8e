// Sums over pixels in double.
#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace etendue
{
namespace
{
bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// error / size, where 0/0 is an exact zero.
double relative(double error, double size)
{
    return error == 0.0 ? 0.0 : error / size;
}

// Squared errors of one pixel, summed over its channels.
struct PixelError {
    double absolute = 0.0, relative = 0.0;
};

// Sum without the `count` largest values.
double sum_without_largest(std::vector<double> values, std::size_t count)
{
    const auto end_of_rest = values.end() - static_cast<std::ptrdiff_t>(count);
    std::nth_element(values.begin(), end_of_rest, values.end());
    return std::accumulate(values.begin(), end_of_rest, 0.0);
}

std::vector<double> each(const std::vector<PixelError>& errors, double PixelError::*member)
{
    std::vector<double> values;
    values.reserve(errors.size());
    for (const PixelError& error : errors) values.push_back(error.*member);
    return values;
}

// What needs the errors of all pixels together.
void add_shares(Metrics& m, const std::vector<PixelError>& errors, double trimmed_share)
{
    const auto worst = static_cast<std::size_t>(std::ceil(trimmed_share * static_cast<double>(errors.size())));
    const std::size_t trimmed = std::min(worst, errors.size());
    const double kept = 3.0 * static_cast<double>(errors.size() - trimmed);
    m.trimmed_relmse = relative(sum_without_largest(each(errors, &PixelError::relative), trimmed), kept);

    const std::vector<double> absolute = each(errors, &PixelError::absolute);
    const double sum = std::accumulate(absolute.begin(), absolute.end(), 0.0);
    m.top_share = relative(sum - sum_without_largest(absolute, trimmed), sum);
}
} // namespace

Metrics compare_pictures(std::span<const Vec3> picture, std::span<const Vec3> reference, const MetricSettings& settings)
{
    if (picture.size() != reference.size()) throw std::invalid_argument("pictures of different sizes are compared");
    Metrics m;

    // Find what can be compared, and how bright the reference is.
    std::vector<std::size_t> finite;
    double peak = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const Vec3 &x = picture[i], &r = reference[i];
        if (x.x < 0.0 || x.y < 0.0 || x.z < 0.0) ++m.negative;
        if (!is_finite(x) || !is_finite(r)) {
            ++m.non_finite;
            continue;
        }
        finite.push_back(i);
        sum += r.x + r.y + r.z;
        peak = std::max({peak, r.x, r.y, r.z});
    }
    // Of no pixels, every mean is 0/0: nothing is known.
    const double values = 3.0 * static_cast<double>(finite.size());
    m.reference_mean = sum / values;

    // Sum the errors.
    const double epsilon = settings.relative_epsilon * m.reference_mean;
    std::vector<PixelError> errors;
    errors.reserve(finite.size());
    for (const std::size_t i : finite) {
        PixelError pixel;
        for (int c = 0; c < 3; ++c) {
            const double error = picture[i][c] - reference[i][c];
            const double ratio = relative(std::abs(error), std::hypot(reference[i][c], epsilon));
            pixel.absolute += error * error;
            pixel.relative += ratio * ratio;
            m.mean_error += error;
            m.mape += ratio;
            m.max_relative = std::max(m.max_relative, ratio);
        }
        m.mse += pixel.absolute;
        m.relmse += pixel.relative;
        errors.push_back(pixel);
    }
    for (double* mean : {&m.mse, &m.relmse, &m.mape, &m.mean_error}) *mean /= values;
    m.psnr = m.mse == 0.0 ? std::numeric_limits<double>::infinity() : 10.0 * std::log10(peak * peak / m.mse);
    if (finite.empty())
        m.max_relative = m.trimmed_relmse = m.top_share = std::numeric_limits<double>::quiet_NaN();
    else
        add_shares(m, errors, settings.trimmed_share);
    return m;
}

const std::vector<MetricName>& metric_names()
{
    static const std::vector<MetricName> names{
        {"mse", "MSE", "mean (x - r)^2", &Metrics::mse},
        {"relmse", "relMSE", "mean (x - r)^2 / (r^2 + (0.01 mean r)^2)", &Metrics::relmse},
        {"mape", "MAPE", "mean |x - r| / sqrt(r^2 + (0.01 mean r)^2)", &Metrics::mape},
        {"max_relative", "largest relative error", "largest |x - r| / sqrt(r^2 + (0.01 mean r)^2)",
         &Metrics::max_relative},
        {"mean_error", "mean error", "mean x - r, signed", &Metrics::mean_error},
        {"psnr", "PSNR", "10 log10((largest r)^2 / MSE), in dB", &Metrics::psnr},
        {"trimmed_relmse", "trimmed relMSE", "relMSE without the worst 0.1 % of pixels: biased",
         &Metrics::trimmed_relmse},
        {"top_share", "share of the worst", "share of the MSE in the worst 0.1 % of pixels", &Metrics::top_share},
    };
    return names;
}
} // namespace etendue
