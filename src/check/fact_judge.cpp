// What a picture says of a fact.
#include "check/fact.h"
#include "check/statistics.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using FactRule = ExpectedFact::Rule;

std::string numbers_text(const std::vector<double>& numbers)
{
    std::string text;
    for (const double x : numbers) text += fmt::format("{}{:.7g}", text.empty() ? "" : " ", x);
    return text;
}

void add_note(CheckResult& result, const std::string& text)
{
    result.note += (result.note.empty() ? "" : "; ") + text;
}

void pass_if(CheckResult& result, bool passed)
{
    result.verdict = passed ? Verdict::passed : Verdict::failed;
}

// How far x is from a value, in roundings of it.
double roundings_off(double x, double value)
{
    if (x == value) return 0.0;
    const double off = std::abs(x - value) / (FLOAT_ROUNDING * std::abs(value));
    return std::isnan(off) ? INFINITY : off;
}

// The same where all that is more than the value counts, and all that is negative.
double roundings_beyond(double x, double value)
{
    return x >= 0.0 && x <= value ? 0.0 : roundings_off(x, x < 0.0 ? 0.0 : value);
}

bool channels_differ(const CheckPicture& picture)
{
    return std::any_of(picture.pixels.begin(), picture.pixels.end(),
                       [](const PixelEstimate& p) { return p.mean.x != p.mean.y || p.mean.y != p.mean.z; });
}

// One formula for all channels is one test, which is fair only where they are one number.
bool check_channels(CheckResult& result, const Fact& fact, const CheckPicture& picture)
{
    if (fact.value.size() == 3 || !channels_differ(picture)) return true;
    result.verdict = Verdict::failed;
    add_note(result, "the channels differ: this fact needs three values");
    return false;
}

int channel_count(const Fact& fact)
{
    return static_cast<int>(fact.value.size());
}

// Test the difference of two means.
MeanTest test_difference(const ChannelEstimate& a, const ChannelEstimate& b, const CheckContext& context)
{
    const double error = std::hypot(a.standard_error, b.standard_error);
    return test_mean(a.mean, error, std::min(a.degrees, b.degrees), b.mean, context,
                     std::max(a.largest_share, b.largest_share));
}

// The worst of the channels' results.
CheckResult worst_of(const std::vector<CheckResult>& channels)
{
    const auto rank = [](const CheckResult& r) {
        return r.verdict == Verdict::failed ? 2 : r.verdict == Verdict::underpowered ? 1 : 0;
    };
    const auto is_better = [&](const CheckResult& a, const CheckResult& b) {
        return rank(a) != rank(b) ? rank(a) < rank(b) : a.statistic < b.statistic;
    };
    return *std::max_element(channels.begin(), channels.end(), is_better);
}
} // namespace

void judge_pixels(CheckResult& result, const Fact& fact, const CheckPicture& picture)
{
    const auto off = fact.text.rule == FactRule::bound ? roundings_beyond : roundings_off;
    double worst = 0.0, found = fact.value[0], least = picture.pixels.front().mean[0];
    std::size_t others = 0;
    for (const PixelEstimate& pixel : picture.pixels) {
        least = std::min({least, pixel.mean.x, pixel.mean.y, pixel.mean.z});
        double pixel_worst = 0.0, other_worst = 0.0;
        for (int c = 0; c < 3; ++c) {
            pixel_worst = std::max(pixel_worst, off(pixel.mean[c], fact.value_of(c)));
            if (!fact.other.empty()) other_worst = std::max(other_worst, roundings_off(pixel.mean[c], fact.other[0]));
        }
        if (!fact.other.empty() && pixel_worst > fact.tolerance && other_worst <= fact.tolerance) {
            ++others;
            continue;
        }
        if (pixel_worst < worst) continue;
        worst = pixel_worst;
        found = pixel.mean[0];
    }
    result.expected = numbers_text(fact.value);
    result.found = numbers_text({found});
    result.statistic = worst;
    result.unit = "ulp";
    result.critical = fact.tolerance;
    pass_if(result, worst <= fact.tolerance);
    if (fact.text.rule == FactRule::bound) add_note(result, fmt::format("the least is {:.3g}", least));
    if (fact.other.empty()) return;

    const double share = static_cast<double>(others) / static_cast<double>(picture.pixels.size());
    add_note(result, fmt::format("{:.3g} % of the pixels are {:.7g}", 100.0 * share, fact.other[0]));
    if (share >= fact.text.other_share.x && share <= fact.text.other_share.y) return;
    result.verdict = Verdict::failed;
    add_note(result, fmt::format("from {:.3g} % to {:.3g} % may be", 100.0 * fact.text.other_share.x,
                                 100.0 * fact.text.other_share.y));
}

void judge_mean(CheckResult& result, const Fact& fact, const CheckPicture& picture, const CheckContext& context)
{
    result.expected = numbers_text(fact.value);
    if (!check_channels(result, fact, picture)) return;
    CheckContext own = context;
    if (fact.delta) own.delta = *fact.delta;
    std::vector<CheckResult> channels;
    for (int c = 0; c < channel_count(fact); ++c) {
        const ChannelEstimate estimate = estimate_channel(picture, c);
        CheckResult one = result;
        one.found = numbers_text({estimate.mean});
        if (fact.text.rule == FactRule::stat) {
            one.largest_share = estimate.largest_share;
            judge(one,
                  test_mean(estimate.mean, estimate.standard_error, estimate.degrees, fact.value_of(c), own,
                            estimate.largest_share, fact.tolerance),
                  own);
        } else {
            const auto off = fact.text.rule == FactRule::bound ? roundings_beyond : roundings_off;
            one.statistic = off(estimate.mean, fact.value_of(c));
            one.unit = "ulp";
            one.critical = fact.tolerance;
            pass_if(one, one.statistic <= fact.tolerance);
        }
        channels.push_back(one);
    }
    result = worst_of(channels);
}

void judge_moment(CheckResult& result, const Fact& fact, const CheckPicture& picture)
{
    result.expected = numbers_text(fact.value);
    if (!check_channels(result, fact, picture)) return;
    std::vector<CheckResult> channels;
    for (int c = 0; c < channel_count(fact); ++c) {
        const ChannelEstimate e = estimate_channel(picture, c);
        const bool is_variance = fact.text.subject == ExpectedFact::Subject::relative_variance;
        const double found = is_variance ? e.variance / (e.mean * e.mean) : e.variance + e.mean * e.mean;
        const double error = is_variance ? e.variance_error / (e.mean * e.mean) : e.variance_error;
        const double value = fact.value_of(c), ratio = found / value;
        CheckResult one = result;
        one.found = numbers_text({found});
        one.unit = "x limit";
        one.critical = 1.0;
        const bool is_bound = fact.text.rule == FactRule::bound;
        one.statistic = is_bound ? ratio / (1.0 + fact.tolerance) : std::abs(ratio - 1.0) / fact.tolerance;
        pass_if(one, one.statistic <= 1.0);
        // A moment that is known less well than the tolerance says nothing.
        if (!is_bound && !(2.0 * error <= fact.tolerance * value) && one.verdict == Verdict::passed) {
            one.verdict = Verdict::underpowered;
            add_note(one, fmt::format("known to {:.2g} % only", 100.0 * error / value));
        }
        channels.push_back(one);
    }
    result = worst_of(channels);
}

void judge_rays(CheckResult& result, const Fact& fact, const CheckPicture& picture)
{
    const double samples = static_cast<double>(picture.pixels.size() * picture.report.samples_per_pixel);
    const double found = static_cast<double>(picture.report.rays()) / samples;
    result.expected = fmt::format("at least {:.7g}", fact.value[0]);
    result.found = numbers_text({found});
    result.statistic = fact.value[0] / found;
    result.unit = "x limit";
    result.critical = 1.0;
    pass_if(result, found >= fact.value[0]);
}

namespace
{
void judge_same_bits(CheckResult& result, const CheckPicture& picture, const CheckPicture& other)
{
    std::size_t different = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const PixelEstimate &a = picture.pixels[i], &b = other.pixels[i];
        different += a.mean != b.mean || a.standard_error != b.standard_error || a.samples != b.samples;
    }
    result.expected = "equal bits";
    result.found = fmt::format("{} of {} differ", different, picture.pixels.size());
    result.statistic = static_cast<double>(different);
    result.unit = "violations";
    result.critical = 0.0;
    pass_if(result, different == 0);
}

void judge_near(CheckResult& result, const Fact& fact, const CheckPicture& picture, const CheckPicture& other)
{
    double mean = 0.0;
    for (int c = 0; c < 3; ++c) mean += estimate_channel(other, c).mean / 3.0;
    std::size_t far = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        bool is_near = true;
        for (int c = 0; c < 3; ++c)
            is_near &= std::abs(picture.pixels[i].mean[c] - other.pixels[i].mean[c]) <= fact.tolerance * mean;
        far += !is_near;
    }
    const double pixels = static_cast<double>(picture.pixels.size());
    result.expected = fmt::format("{:.4g} % within {:.2g}", 100.0 * fact.text.share, fact.tolerance);
    result.found = fmt::format("{} of {} farther", far, picture.pixels.size());
    result.statistic = static_cast<double>(far);
    result.unit = "violations";
    result.critical = std::floor((1.0 - fact.text.share) * pixels * (1.0 + 1e-12));
    pass_if(result, result.statistic <= result.critical);
}
} // namespace

void judge_same(CheckResult& result, const Fact& fact, const CheckPicture& picture, const CheckPicture& other,
                const CheckContext& context)
{
    if (picture.width != other.width || picture.height != other.height) {
        result.verdict = Verdict::failed;
        add_note(result, "the pictures have different sizes");
        return;
    }
    if (fact.text.rule == FactRule::exact) return judge_same_bits(result, picture, other);
    if (fact.text.rule == FactRule::count) return judge_near(result, fact, picture, other);
    CheckContext own = context;
    if (fact.delta) own.delta = *fact.delta;
    std::vector<CheckResult> channels;
    for (int c = 0; c < 3; ++c) {
        const ChannelEstimate a = estimate_channel(picture, c), b = estimate_channel(other, c);
        CheckResult one = result;
        one.expected = numbers_text({b.mean});
        one.found = numbers_text({a.mean});
        one.largest_share = std::max(a.largest_share, b.largest_share);
        judge(one, test_difference(a, b, own), own);
        channels.push_back(one);
    }
    result = worst_of(channels);
}

void judge_message(CheckResult& result, const Fact& fact, const std::vector<std::string>& messages)
{
    result.expected = "\"" + fact.text.text + "\"";
    const bool found = std::any_of(messages.begin(), messages.end(), [&](const std::string& message) {
        return message.find(fact.text.text) != std::string::npos;
    });
    result.found = found ? "said" : messages.empty() ? "nothing said" : messages.front();
    pass_if(result, found);
}
} // namespace etendue
