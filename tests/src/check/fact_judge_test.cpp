// What facts say of pictures made by hand.
#include "check/fact.h"
#include "check/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;
using Catch::Contains;
using FactRule = ExpectedFact::Rule;
using Subject = ExpectedFact::Subject;

namespace
{
// Pixels of 100 samples each whose error is that of the given variance of a sample.
CheckPicture picture_of(const std::vector<Vec3>& means, double variance = 0.0, std::uint64_t samples = 100)
{
    CheckPicture picture;
    picture.width = static_cast<int>(means.size());
    picture.height = 1;
    const double error = samples < 2 ? INFINITY : std::sqrt(variance / static_cast<double>(samples));
    for (const Vec3& mean : means) picture.pixels.push_back({mean, Vec3(error), samples, 0});
    return picture;
}

CheckPicture grey(const std::vector<double>& means, double variance = 0.0, std::uint64_t samples = 100)
{
    std::vector<Vec3> colours;
    for (const double mean : means) colours.emplace_back(mean);
    return picture_of(colours, variance, samples);
}

Fact fact(Subject subject, FactRule rule, std::vector<double> value, double tolerance = 0.0)
{
    Fact fact;
    fact.text.subject = subject;
    fact.text.rule = rule;
    fact.value = std::move(value);
    fact.tolerance = tolerance;
    return fact;
}

CheckResult pixels(const Fact& fact, const CheckPicture& picture)
{
    CheckResult result;
    judge_pixels(result, fact, picture);
    return result;
}

CheckResult mean(const Fact& fact, const CheckPicture& picture)
{
    CheckContext context;
    context.test_alpha = 0.05;
    CheckResult result;
    judge_mean(result, fact, picture, context);
    return result;
}

CheckResult moment(const Fact& fact, const CheckPicture& picture)
{
    CheckResult result;
    judge_moment(result, fact, picture);
    return result;
}
} // namespace

TEST_CASE("every pixel must be within its roundings", "[host]")
{
    const Fact four = fact(Subject::pixels, FactRule::round, {2.0}, 4.0);
    const double step = 2.0 * FLOAT_ROUNDING;
    CHECK(pixels(four, grey({2.0, 2.0 + 4 * step, 2.0 - 4 * step})).verdict == Verdict::passed);
    const CheckResult off = pixels(four, grey({2.0, 2.0 + 5 * step, 2.0}));
    CHECK(off.verdict == Verdict::failed);
    CHECK(off.statistic == Approx(5.0));
    CHECK(pixels(four, grey({2.0, std::nan(""), 2.0})).verdict == Verdict::failed);
    // Each channel has its own value.
    const Fact colour = fact(Subject::pixels, FactRule::round, {1.0, 2.0, 3.0});
    CHECK(pixels(colour, picture_of({{1, 2, 3}})).verdict == Verdict::passed);
    CHECK(pixels(colour, picture_of({{1, 2, 3}, {1, 3, 2}})).verdict == Verdict::failed);
}

TEST_CASE("an exact pixel is equal, and nothing rounds to zero", "[host]")
{
    const Fact zero = fact(Subject::pixels, FactRule::exact, {0.0});
    CHECK(pixels(zero, grey({0.0, 0.0})).verdict == Verdict::passed);
    CHECK(pixels(zero, grey({0.0, 1e-38})).verdict == Verdict::failed);
    const Fact nine = fact(Subject::pixels, FactRule::exact, {9.0});
    CHECK(pixels(nine, grey({9.0, 9.0 + 1e-12})).verdict == Verdict::failed);
}

TEST_CASE("a bound holds below its value and not below zero", "[host]")
{
    const Fact bound = fact(Subject::pixels, FactRule::bound, {1.0}, 8.0);
    CHECK(pixels(bound, grey({0.0, 0.5, 1.0 + 8 * FLOAT_ROUNDING})).verdict == Verdict::passed);
    CHECK(pixels(bound, grey({0.0, 1.0 + 9 * FLOAT_ROUNDING})).verdict == Verdict::failed);
    CHECK(pixels(bound, grey({0.5, -1e-9})).verdict == Verdict::failed);
}

TEST_CASE("so many pixels may have the other value, no more and no fewer", "[host]")
{
    Fact either = fact(Subject::pixels, FactRule::round, {0.5}, 1.0);
    either.other = {1.0};
    either.text.other_share = {0.2, 0.5};
    CHECK(pixels(either, grey({0.5, 0.5, 1.0, 0.5})).verdict == Verdict::passed);
    CHECK(pixels(either, grey({0.5, 0.5, 0.5, 0.5})).verdict == Verdict::failed);
    const CheckResult many = pixels(either, grey({1.0, 1.0, 1.0, 0.5}));
    CHECK(many.verdict == Verdict::failed);
    CHECK_THAT(many.note, Contains("75 % of the pixels are 1"));
    // What is neither is wrong whatever the share.
    CHECK(pixels(either, grey({0.5, 0.75, 1.0, 0.5})).verdict == Verdict::failed);
    // A pixel is one or the other, not some channels of each.
    CHECK(pixels(either, picture_of({{0.5, 0.5, 0.5}, {0.5, 1.0, 0.5}, {1, 1, 1}})).verdict == Verdict::failed);
}

TEST_CASE("the mean of all pixels is tested with the error of their samples", "[host]")
{
    const Fact one = fact(Subject::mean, FactRule::stat, {1.0}, 16.0);
    std::vector<double> means(400, 1.0);
    // 40000 samples of variance 0.01: the standard error is 5e-4.
    const CheckResult result = mean(one, grey(means, 0.01));
    CHECK(result.verdict == Verdict::passed);
    CHECK(result.detectable_bias == Approx((1.96 + 2.33) * 5e-4).epsilon(1e-3));
    means.assign(400, 1.002);
    const CheckResult biased = mean(one, grey(means, 0.01));
    CHECK(biased.verdict == Verdict::failed);
    CHECK(biased.statistic == Approx(4.0).epsilon(0.01));
    // A fact may ask for less power than the run, or for more.
    means.assign(400, 1.0);
    Fact keen = one;
    keen.delta = 0.002;
    CHECK(mean(keen, grey(means, 0.01)).verdict == Verdict::underpowered);
    // The worst channel counts.
    const Fact colour = fact(Subject::mean, FactRule::stat, {1.0, 1.0, 1.0}, 16.0);
    CHECK(mean(colour, picture_of(std::vector<Vec3>(400, {1, 1, 1.002}), 0.01)).verdict == Verdict::failed);
}

TEST_CASE("pixels of one sample have the variance that they have among each other", "[host]")
{
    std::vector<double> means;
    for (int i = 0; i < 1000; ++i) means.push_back(i % 2);
    const ChannelEstimate estimate = estimate_channel(grey(means, 0.0, 1), 0);
    CHECK(estimate.mean == 0.5);
    CHECK(estimate.variance == Approx(0.25).epsilon(2e-3));
    CHECK(estimate.standard_error == Approx(0.5 / std::sqrt(1000.0)).epsilon(2e-3));
    CHECK(estimate.largest_share == Approx(1.0 / 500));
}

TEST_CASE("channels that differ are not one test", "[host]")
{
    const CheckResult result =
        mean(fact(Subject::mean, FactRule::stat, {1.0}, 16.0), picture_of({{1, 1, 2}, {1, 1, 2}}));
    CHECK(result.verdict == Verdict::failed);
    CHECK_THAT(result.note, Contains("three values"));
}

TEST_CASE("a variance and a second moment are within their tolerance, or below their bound", "[host]")
{
    // Pixels of mean 2 and variance 0.4: relative variance 0.1, second moment 4.4.
    const CheckPicture picture = grey(std::vector<double>(1000, 2.0), 0.4);
    CHECK(moment(fact(Subject::relative_variance, FactRule::stat, {0.1}, 0.02), picture).verdict == Verdict::passed);
    CHECK(moment(fact(Subject::relative_variance, FactRule::stat, {0.11}, 0.05), picture).verdict == Verdict::failed);
    CHECK(moment(fact(Subject::relative_variance, FactRule::bound, {0.11}), picture).verdict == Verdict::passed);
    CHECK(moment(fact(Subject::relative_variance, FactRule::bound, {0.09}), picture).verdict == Verdict::failed);
    CHECK(moment(fact(Subject::second_moment, FactRule::stat, {4.4}, 0.01), picture).verdict == Verdict::passed);
    CHECK(moment(fact(Subject::second_moment, FactRule::stat, {4.0}, 0.05), picture).verdict == Verdict::failed);
}

TEST_CASE("a variance that is known less well than its tolerance says nothing", "[host]")
{
    CheckPicture picture = grey(std::vector<double>(100, 2.0), 0.4);
    // Half of the pixels have hardly any variance, the others twice as much: the mean variance is known to 10 %.
    for (std::size_t i = 0; i < 100; ++i)
        picture.pixels[i].standard_error = Vec3(i % 2 ? std::sqrt(0.8 / 100.0) : 1e-9);
    CHECK(moment(fact(Subject::relative_variance, FactRule::stat, {0.1}, 0.1), picture).verdict ==
          Verdict::underpowered);
    CHECK(moment(fact(Subject::relative_variance, FactRule::stat, {0.1}, 0.3), picture).verdict == Verdict::passed);
}

TEST_CASE("a variance that single samples do not tell is not known", "[host]")
{
    const CheckPicture picture = grey({1.0, 2.0, 3.0, 2.0}, 0.0, 1);
    CHECK(moment(fact(Subject::relative_variance, FactRule::stat, {1.0 / 6.0}, 0.5), picture).verdict ==
          Verdict::underpowered);
}

TEST_CASE("a channel that is not a number fails, whatever the others are", "[host]")
{
    for (int bad = 0; bad < 3; ++bad) {
        Vec3 mean(1.0);
        mean[bad] = NAN;
        CAPTURE(bad);
        const CheckPicture picture = picture_of({mean, mean}, 0.01);
        CHECK(::mean(fact(Subject::mean, FactRule::stat, {1.0, 1.0, 1.0}, 16.0), picture).verdict == Verdict::failed);
        CHECK(moment(fact(Subject::second_moment, FactRule::bound, {2.0, 2.0, 2.0}), picture).verdict ==
              Verdict::failed);
    }
}

TEST_CASE("the same picture has the same bits, or is near enough, or has the same mean", "[host]")
{
    const auto judge = [](FactRule rule, const CheckPicture& a, const CheckPicture& b, double tolerance = 0.0,
                          double share = 1.0) {
        Fact same = fact(Subject::same, rule, {}, tolerance);
        same.text.share = share;
        CheckContext context;
        context.test_alpha = 0.05;
        CheckResult result;
        judge_same(result, same, a, b, context);
        return result.verdict;
    };
    const CheckPicture a = grey({1.0, 2.0, 3.0, 2.0});
    CHECK(judge(FactRule::exact, a, a) == Verdict::passed);
    CHECK(judge(FactRule::exact, a, grey({1.0, 2.0, 3.0, 2.0 + 1e-15})) == Verdict::failed);
    CHECK(judge(FactRule::exact, a, grey({1.0, 2.0, 3.0})) == Verdict::failed);
    CHECK(judge(FactRule::count, a, grey({1.0, 2.001, 3.0, 2.0}), 1e-3) == Verdict::passed);
    CHECK(judge(FactRule::count, a, grey({1.0, 2.003, 3.0, 2.0}), 1e-3) == Verdict::failed);
    CHECK(judge(FactRule::count, a, grey({1.0, 2.003, 3.0, 2.0}), 1e-3, 0.75) == Verdict::passed);
    CHECK(judge(FactRule::count, a, grey({1.0, std::nan(""), 3.0, 2.0}), 1e-3) == Verdict::failed);
    const std::vector<double> ones(1000, 1.0), more(1000, 1.002);
    CHECK(judge(FactRule::stat, grey(ones, 0.01), grey(ones, 0.01)) == Verdict::passed);
    CHECK(judge(FactRule::stat, grey(ones, 0.01), grey(more, 0.01)) == Verdict::failed);
    CHECK(judge(FactRule::stat, grey(ones, 1.0), grey(ones, 1.0)) == Verdict::underpowered);
}

TEST_CASE("a message is found among others, and silence is no message", "[host]")
{
    Fact warns = fact(Subject::warning, FactRule::exact, {});
    warns.text.text = "is black";
    const auto verdict = [&](const std::vector<std::string>& messages) {
        CheckResult result;
        judge_message(result, warns, messages);
        return result.verdict;
    };
    CHECK(verdict({"something", "the picture is black."}) == Verdict::passed);
    CHECK(verdict({"something"}) == Verdict::failed);
    CHECK(verdict({}) == Verdict::failed);
}
