// Error intervals from neighbouring pixels, and the rule for stopping.
#include "render/error_target.h"

#include "render/render_settings.h"
#include "scene/scene_check.h"
#include "util/error.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace etendue
{
namespace
{
constexpr std::size_t LEAST_PIXELS = 64;
constexpr std::uint64_t LEAST_BLOCKS = 4; // where samples depend on each other
constexpr double WORST_SHARE = 0.001;     // of the pixels

// Variance of a sum of independent values from the differences of neighbours, which are alike in what they expect:
// E (a - b)^2 = Var a + Var b, and more where they are not alike.
double variance_of_sum(const std::vector<double>& values)
{
    const std::size_t pairs = values.size() / 2;
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double difference = values[2 * i] - values[2 * i + 1];
        sum += difference * difference;
    }
    return sum * static_cast<double>(values.size()) / static_cast<double>(2 * pairs);
}

// Degrees of freedom of one pixel's squared error.
double degrees_of(const Film& film)
{
    const double samples = static_cast<double>(film.min_samples());
    switch (film.error_estimate()) {
    case ErrorEstimate::blocks:
        return std::floor(samples / SAMPLES_PER_BLOCK) - 1.0;
    case ErrorEstimate::halves:
        return 1.0;
    case ErrorEstimate::samples:
    case ErrorEstimate::none:
        break;
    }
    return samples - 1.0;
}

// Share of the largest values, 0.1 % of them but one at least, in the sum of all.
double top_share(std::vector<double> values, double sum)
{
    if (!(sum > 0.0)) return 0.0;
    const auto count = std::max<std::ptrdiff_t>(
        1, static_cast<std::ptrdiff_t>(std::ceil(WORST_SHARE * static_cast<double>(values.size()))));
    std::nth_element(values.begin(), values.begin() + (count - 1), values.end(), std::greater<>());
    return std::accumulate(values.begin(), values.begin() + count, 0.0) / sum;
}
} // namespace

ErrorInterval estimate_error(const Film& film, double confidence)
{
    const double unknown = std::numeric_limits<double>::infinity();
    const std::vector<double> squared = film.squared_relative_errors();
    const double count = static_cast<double>(squared.size());
    const double sum = std::accumulate(squared.begin(), squared.end(), 0.0);
    // A picture that is black so far tells nothing: its light may be rare.
    const bool is_black = sum == 0.0 && film.is_black();
    if (!std::isfinite(sum) || squared.size() < 2 || is_black) return {unknown, 0.0, unknown, 0.0};
    // How far the sum of the estimates may be from what it expects.
    const double of_estimate = variance_of_sum(squared);
    // How far the sum of the true errors may be: twice the square of each pixel's for means that are normal, where an
    // estimate with d degrees of freedom has a mean square of 1 + 2 / d times that square.
    const double squares = std::inner_product(squared.begin(), squared.end(), squared.begin(), 0.0);
    const double of_truth = 2.0 * squares / (1.0 + 2.0 / degrees_of(film));
    const double spread =
        student_t_quantile(confidence, std::floor(count / 2.0)) * std::sqrt(of_estimate + of_truth) / count;
    const double mean = sum / count;
    return {std::sqrt(mean), std::sqrt(std::max(mean - spread, 0.0)), std::sqrt(mean + spread),
            top_share(squared, sum)};
}

void check_error_target(const Scene& scene, const PixelRect& crop)
{
    if (scene.integrator.type == IntegratorType::normals)
        throw UsageError("The normals integrator takes one sample of each pixel, which tells no error: --error needs "
                         "another integrator.");
    if (error_estimate_of(scene) == ErrorEstimate::none)
        throw UsageError("A single Sobol sequence does not tell its error: --error needs the sampler's replicates to "
                         "be 2, for example by -D sampler.replicates=2.");
    if (!is_lit(scene))
        throw UsageError("Nothing in the scene emits light: its picture is black, and has no relative error.");
    const std::size_t pixels = static_cast<std::size_t>(crop.width) * static_cast<std::size_t>(crop.height);
    if (pixels < LEAST_PIXELS)
        throw UsageError(fmt::format("{} pixels do not tell how well their error is known: --error needs {} at least.",
                                     pixels, LEAST_PIXELS));
}

ErrorTarget::ErrorTarget(const Film& film, double wanted, double confidence)
    : film_(film), wanted_(wanted), confidence_(confidence)
{
}

bool ErrorTarget::go_on(const PassEnd& end)
{
    const bool independent = film_.error_estimate() == ErrorEstimate::samples;
    const std::uint64_t least = SAMPLES_PER_BLOCK * (independent ? 1 : LEAST_BLOCKS);
    if (end.samples_per_pixel < std::max(least, next_look_)) return true;
    // The halves are compared when they are equal.
    if (film_.error_estimate() == ErrorEstimate::halves && end.samples_per_pixel % (2 * SAMPLES_PER_BLOCK) != 0)
        return true;
    ++looks_;
    const bool below = estimate_error(film_, confidence_).high <= wanted_;
    reached_ = below && was_below_;
    was_below_ = below;
    // Look again at once to confirm, else when there is something new to see: every look is a chance to be lucky.
    next_look_ = below ? 0 : end.samples_per_pixel + end.samples_per_pixel / 16;
    return !reached_;
}

ErrorTarget::Report ErrorTarget::report() const
{
    return {wanted_, confidence_, reached_, looks_, estimate_error(film_, confidence_)};
}
} // namespace etendue
