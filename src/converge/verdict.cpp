// The three parts, and what they come to.
#include "converge/verdict.h"

#include "math/rounding.h"
#include "util/statistics.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
// A test that sees a bias with this certainty counts as able to see it.
constexpr double POWER = 0.99;
// Fewer p-values are not compared with uniform ones.
constexpr int FEWEST_TILES = 5;
// Student's distribution is the normal one.
constexpr double MANY_DEGREES = 1e6;

double mean_of_channels(const Vec3& v)
{
    return (v.x + v.y + v.z) / 3.0;
}

// The variance of rounding, so that differences of one unit in the last place are no discovery.
double rounding_variance(double value)
{
    const double deviation = MEAN_ROUNDINGS * FLOAT_ROUNDING * value;
    return deviation * deviation;
}

std::vector<PixelMoments> moments_of(const Pixels& mean, const Pixels& variance, double degrees, double skewness)
{
    std::vector<PixelMoments> moments;
    for (std::size_t i = 0; i < mean.size(); ++i) moments.push_back({mean[i], variance[i], degrees, skewness});
    return moments;
}

double reference_mean(const BiasEvidence& evidence)
{
    return mean_of_channels(mean_of(evidence.reference->mean));
}

// Errors that fall faster than 1 / N have a fitted floor below zero; those of rounding have one of their own.
bool has_floor(const BiasEvidence& evidence)
{
    return evidence.floor.known() && evidence.floor.low > rounding_variance(reference_mean(evidence));
}

void judge_floor(BiasVerdict& verdict, const BiasEvidence& evidence, double delta)
{
    // What could hide must be no more than the last error, or than a relative error of delta in every pixel.
    const double hidden = std::max(FLOOR_POWER * evidence.last_mse, std::pow(delta * reference_mean(evidence), 2.0));
    verdict.floor = evidence.floor;
    verdict.floor_passed = evidence.floor.known() && !has_floor(evidence) && evidence.floor.high <= hidden;
    if (has_floor(evidence))
        verdict.reasons.push_back(
            fmt::format("The errors do not fall to zero: MSE = a / N + b has b = {:.3g}, between {:.3g} and {:.3g}.",
                        evidence.floor.estimate, evidence.floor.low, evidence.floor.high));
    else if (!verdict.floor_passed)
        verdict.reasons.push_back(
            fmt::format("A floor {:g} times the last error could hide under the errors: that takes at least three "
                        "checkpoints above the reference's own error, and more seeds or checkpoints.",
                        std::sqrt(FLOOR_POWER)));
}

// Whether more than a tenth of the tiles with noise is.
bool is_too_skewed(const WelchTiles& tiles)
{
    return 10 * tiles.too_skewed > tiles.p_values.size() - tiles.exact;
}

// Whether tiles see a bias.
bool judge_tiles(BiasVerdict& verdict, const BiasEvidence& evidence, double alpha)
{
    // Half of the level for all tiles together, half for each by itself: one that is far off is a bias too.
    const WelchTiles tiles =
        compare_tiles(*evidence.pool, *evidence.reference, evidence.width, evidence.height, alpha / 2);
    verdict.tile = tiles.tile;
    verdict.tile_p_value = tiles.excess_p_value;
    verdict.uniform_p_value = tiles.ks_p_value;
    verdict.worst_tile_z = tiles.worst_z;
    // Tiles without any noise that differ have a p-value of 0 and are below the level, too.
    const bool seen = tiles.excess_p_value <= alpha / 2 || tiles.below_alpha > 0;
    verdict.tiles_passed = !seen && !is_too_skewed(tiles);
    if (seen)
        verdict.reasons.push_back(fmt::format("Tiles of {0}x{0} pixels differ from the reference by more than noise: "
                                              "p = {1:.2g}, the worst by {2:.1f} standard errors.",
                                              verdict.tile, verdict.tile_p_value, verdict.worst_tile_z));
    else if (!verdict.tiles_passed)
        verdict.reasons.emplace_back(
            "Rare bright samples make the noise of the tiles too skewed to be judged: take more "
            "samples, or a larger picture.");
    return seen;
}

// The variance of the mean of all seeds' pictures, and its degrees of freedom.
struct MeanVariance {
    double variance = 0.0, degrees = 0.0;
};

MeanVariance variance_of_mean(const BiasEvidence& evidence, int channel)
{
    RunningStatistics means;
    double by_film = 0.0;
    for (const Vec3& mean : evidence.picture_means) means.add(mean[channel]);
    for (const Vec3& variance : evidence.picture_variances) by_film += variance[channel];
    const double seeds = static_cast<double>(means.count());
    // Independent samples of every pixel know far more than a few seeds do; other samples know only by seeds.
    if (evidence.independent_samples && std::isfinite(by_film)) return {by_film / (seeds * seeds), MANY_DEGREES};
    return {means.variance() / seeds, seeds - 1};
}

// The third cumulant of the picture's mean.
double third_cumulant(const Pixels& variance, double skewness, int channel)
{
    if (skewness == 0.0) return 0.0;
    double sum = 0.0;
    for (const Vec3& v : variance) sum += std::pow(v[channel], 1.5);
    return skewness * sum / std::pow(static_cast<double>(variance.size()), 3.0);
}

// One channel: the means of the seeds against the reference's; whether it sees a bias.
bool judge_channel(BiasVerdict& verdict, const BiasEvidence& evidence, int channel, const VerdictLevels& levels)
{
    const Reference& reference = *evidence.reference;
    std::vector<double> means;
    for (const Vec3& mean : evidence.picture_means) means.push_back(mean[channel]);
    const double expected = mean_of(reference.mean)[channel];
    const MeanVariance of_seeds = variance_of_mean(evidence, channel);
    const double of_reference = mean_of(reference.variance)[channel] / static_cast<double>(reference.variance.size());
    const double variance = of_seeds.variance + of_reference + rounding_variance(expected);
    if (variance == 0.0) return false; // a channel that is black in every picture
    // Welch and Satterthwaite; of the reference's variance so many pixels know enough.
    const double part = of_seeds.variance / variance;
    const double degrees = part > 0.0 ? std::min(of_seeds.degrees / (part * part), MANY_DEGREES) : MANY_DEGREES;
    const double error = std::sqrt(variance);
    const PixelPool& pool = *evidence.pool;
    const double skewness = (third_cumulant(pool.variance_of_mean(), pool.skewness_of_mean(), channel) -
                             third_cumulant(reference.variance, reference.skewness, channel)) /
                            (variance * error);
    const double z = without_skewness((mean_of(means) - expected) / error, skewness);
    const double critical = student_t_quantile(1.0 - levels.test_alpha / 2, degrees);
    const double needed = with_skewness(critical, skewness);
    const double detectable = (needed + student_t_quantile(POWER, degrees)) * error / std::abs(expected);
    const bool is_known = std::abs(skewness) <= LARGEST_SKEWNESS;
    const bool seen = is_known && !(std::abs(z) < critical);
    verdict.mean_passed = verdict.mean_passed && is_known && !seen;
    if (!is_known && std::isfinite(verdict.z)) return false;
    if (!std::isfinite(verdict.z) || std::abs(z) / critical > std::abs(verdict.z) / verdict.critical) {
        verdict.z = z;
        verdict.critical = critical;
        verdict.mean_error = (mean_of(means) - expected) / std::abs(expected);
    }
    if (!(verdict.detectable_bias >= detectable)) verdict.detectable_bias = detectable;
    return seen;
}

bool judge_mean(BiasVerdict& verdict, const BiasEvidence& evidence, const VerdictLevels& levels)
{
    verdict.mean_passed = true;
    bool seen = false;
    for (int c = 0; c < 3; ++c) seen = judge_channel(verdict, evidence, c, levels) || seen;
    if (seen)
        verdict.reasons.push_back(fmt::format("The picture's mean is off by {:+.3g} %: {:.1f} standard errors, where "
                                              "{:.2f} are allowed.",
                                              100 * verdict.mean_error, verdict.z, verdict.critical));
    else if (!verdict.mean_passed)
        verdict.reasons.emplace_back(
            "Rare bright samples make the noise of the picture's mean too skewed to be judged: "
            "take more samples.");
    return seen;
}

bool slope_is_wrong(const BiasEvidence& evidence)
{
    return evidence.independent_samples && evidence.slope.known() &&
           (evidence.slope.low > EXPECTED_SLOPE + SLOPE_TOLERANCE ||
            evidence.slope.high < EXPECTED_SLOPE - SLOPE_TOLERANCE);
}

// What makes a run worthless whatever its picture looks like.
bool has_failed(BiasVerdict& verdict, const BiasEvidence& evidence)
{
    if (evidence.accidents > 0)
        verdict.reasons.push_back(
            fmt::format("{} samples were not finite, negative or otherwise impossible; the first: {}.",
                        evidence.accidents, evidence.replay.empty() ? "unknown" : evidence.replay));
    if (evidence.bad_values > 0)
        verdict.reasons.push_back(
            fmt::format("{} values of the pictures are not finite or negative.", evidence.bad_values));
    return !verdict.reasons.empty();
}

bool is_exact(const BiasEvidence& evidence)
{
    return evidence.largest_mse <= rounding_variance(reference_mean(evidence));
}

// The three parts; whether one of them sees a bias.
bool sees_bias(BiasVerdict& verdict, const BiasEvidence& evidence, const VerdictLevels& levels)
{
    if (verdict.exact)
        verdict.floor_passed = true;
    else
        judge_floor(verdict, evidence, levels.delta);
    const bool by_tiles = judge_tiles(verdict, evidence, levels.test_alpha);
    const bool by_mean = judge_mean(verdict, evidence, levels);
    return (!verdict.exact && has_floor(evidence)) || by_tiles || by_mean;
}

// Whether the errors fall at an impossible rate. A floor bends the slope too.
bool judge_slope(BiasVerdict& verdict, const BiasEvidence& evidence)
{
    if (verdict.exact || !slope_is_wrong(evidence)) return false;
    verdict.reasons.push_back(fmt::format("The errors of independent samples must fall with slope -1 within {}, and "
                                          "fall with {:.3f}, between {:.3f} and {:.3f}.",
                                          SLOPE_TOLERANCE, evidence.slope.estimate, evidence.slope.low,
                                          evidence.slope.high));
    return true;
}
} // namespace

const char* bias_result_name(BiasResult result)
{
    switch (result) {
    case BiasResult::unbiased:
        return "UNBIASED";
    case BiasResult::biased:
        return "BIASED";
    case BiasResult::underpowered:
        return "UNDERPOWERED";
    case BiasResult::failed:
        return "FAILED";
    case BiasResult::unknown:
        break;
    }
    return "UNKNOWN";
}

int tile_edge(int width, int height)
{
    return std::clamp(std::min(width, height) / 8, 1, 8);
}

WelchTiles compare_tiles(const PixelPool& pool, const Reference& reference, int width, int height, double alpha)
{
    const double degrees = static_cast<double>(pool.count()) - 1;
    const auto a = moments_of(pool.mean(), pool.variance_of_mean(), degrees, pool.skewness_of_mean());
    const auto b = moments_of(reference.mean, reference.variance, reference.degrees, reference.skewness);
    // Larger tiles are less skewed.
    int edge = tile_edge(width, height);
    WelchTiles tiles = welch_test(a, b, width, height, edge, alpha);
    while (is_too_skewed(tiles) && (width / (2 * edge)) * (height / (2 * edge)) >= FEWEST_TILES)
        tiles = welch_test(a, b, width, height, edge *= 2, alpha);
    return tiles;
}

BiasVerdict judge_bias(const BiasEvidence& evidence, const VerdictLevels& levels)
{
    BiasVerdict verdict;
    const bool is_blind = evidence.reference->kind == Reference::Kind::none;
    const bool has_pictures = evidence.picture_means.size() >= 2;
    verdict.exact = !is_blind && has_pictures && is_exact(evidence);
    const bool failed = has_failed(verdict, evidence);
    if (is_blind)
        verdict.reasons.emplace_back("Without a reference only the spread between seeds is seen, and no bias.");
    else if (!has_pictures)
        verdict.reasons.emplace_back("Fewer than two seeds reached the last checkpoint.");
    else if (verdict.exact)
        verdict.reasons.emplace_back("Every picture is the reference but for rounding.");

    const bool can_see = !is_blind && has_pictures && evidence.bad_values == 0;
    const bool seen = can_see && sees_bias(verdict, evidence, levels);
    if (seen && !evidence.reference->knows_error)
        verdict.reasons.emplace_back("The reference's own error is not known and may be what is seen.");
    const bool wrong_slope = judge_slope(verdict, evidence);
    const bool weak_mean = verdict.detectable_bias > levels.delta;
    if (failed || (wrong_slope && !seen))
        verdict.result = BiasResult::failed;
    else if (seen && !evidence.reference->knows_error)
        verdict.result = BiasResult::unknown;
    else if (seen)
        verdict.result = BiasResult::biased;
    else if (is_blind)
        verdict.result = BiasResult::unknown;
    else if (!has_pictures || !verdict.floor_passed || !verdict.tiles_passed || !verdict.mean_passed || weak_mean)
        verdict.result = BiasResult::underpowered;
    else
        verdict.result = BiasResult::unbiased;
    if (verdict.result == BiasResult::underpowered && weak_mean)
        verdict.reasons.push_back(fmt::format("A bias of {:.2g} % could hide, and {:.2g} % must not: take more samples "
                                              "or seeds.",
                                              100 * verdict.detectable_bias, 100 * levels.delta));
    if (has_pictures && !evidence.independent_samples && evidence.picture_means.size() < ENOUGH_SEEDS)
        verdict.reasons.push_back(
            fmt::format("The errors of these samples are known by the spread between {} seeds only; "
                        "{} or more tell them well.",
                        evidence.picture_means.size(), ENOUGH_SEEDS));
    return verdict;
}
} // namespace etendue
