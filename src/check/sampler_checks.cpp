// Samplers more even than chance: nets counted interval by interval, cells counted one by one.
#include "check/device_functions.h"
#include "check/findings.h"
#include "check/sampling_checks.h"
#include "util/statistics.h"

#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace etendue
{
namespace
{
using Words = std::vector<std::uint32_t>;
using Results = std::vector<CheckResult>;
using Points = std::vector<std::array<std::uint32_t, 2>>;

const DeviceFunctions& functions()
{
    // Input 0: low and high word of the seed, high word of the sample, sampler, replicates; then pixel, sample,
    // dimension.
    static const DeviceFunctions all(
        {"sampling/sampler.h"},
        {{"block", "uint* uint uint uint -> uint uint uint uint",
          "RandomStream s = {in0[0], in0[1], in0[2], in1, in2, in0[3], in0[4]};"
          "RandomBlock b = sampler_block(s, in3); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"}});
    return all;
}

struct Place {
    std::uint32_t pixel, dimension, sample_high;
};

// Far apart and next to each other; the film's last pixel, dimensions of deep vertices, samples beyond 2^32.
std::vector<Place> places()
{
    std::vector<Place> all;
    for (const std::uint32_t pixel : {0u, 1u, 2u, 599u, 16384u * 16384u - 1u})
        for (const std::uint32_t dimension : {0u, 1u, 2u, 3u, 1025u, 131073u})
            for (const std::uint32_t high : {0u, 5u}) all.push_back({pixel, dimension, high});
    return all;
}

Words stream(const CheckContext& context, std::uint32_t sampler, std::uint32_t replicates, std::uint32_t sample_high)
{
    return {static_cast<std::uint32_t>(context.seed) + 7u, static_cast<std::uint32_t>(context.seed >> 32), sample_high,
            sampler, replicates};
}

// The four words of each block.
std::vector<Words> blocks(const CheckContext& context, const Words& stream, const Words& pixels, const Words& samples,
                          const Words& dimensions)
{
    return functions().evaluate(*context.device, "block", {stream, pixels, samples, dimensions}, context.lanes).outputs;
}

// The two points of each sample's block: two lists.
std::array<Points, 2> points(const CheckContext& context, std::uint32_t sampler, std::uint32_t replicates,
                             const Place& place, const Words& samples)
{
    const auto out = blocks(context, stream(context, sampler, replicates, place.sample_high),
                            Words(samples.size(), place.pixel), samples, Words(samples.size(), place.dimension));
    std::array<Points, 2> pairs;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t pair = 0; pair < 2; ++pair) pairs[pair].push_back({out[2 * pair][i], out[2 * pair + 1][i]});
    return pairs;
}

// Whether `count` = 2^m points from `first` on have one in each of the 2^m intervals of 2^-a by 2^(a-m).
bool fills_intervals(const Points& points, std::size_t first, int m, int a)
{
    std::vector<bool> taken(std::size_t{1} << m);
    for (std::size_t i = 0; i < taken.size(); ++i) {
        const std::uint64_t column = std::uint64_t{points[first + i][0]} >> (32 - a);
        const std::uint64_t row = std::uint64_t{points[first + i][1]} >> (32 - (m - a));
        taken[static_cast<std::size_t>(column << (m - a) | row)] = true;
    }
    for (const bool one : taken)
        if (!one) return false;
    return true;
}

// Every prefix of 2^m samples is a (0,2)-net, for both points of a block and each replicate.
Results check_nets(const CheckContext& context)
{
    constexpr int LARGEST = 10;
    Violations violations;
    for (const std::uint32_t replicates : {1u, 2u})
        for (std::uint32_t replicate = 0; replicate < replicates; ++replicate) {
            const Words samples = samples_of_replicate(replicate, replicates, 1u << LARGEST);
            for (const Place& place : places()) {
                violations.set_subject(fmt::format("pixel {}, dimension {}", place.pixel, place.dimension));
                for (const Points& p : points(context, SAMPLER_SOBOL, replicates, place, samples))
                    for (int m = 0; m <= LARGEST; ++m)
                        for (int a = 0; a <= m; ++a)
                            violations.expect(fills_intervals(p, 0, m, a), "an empty interval");
            }
        }
    return {violations.result("sobol-nets")};
}

// Each block of 64 samples has one in each of 8x8 cells, for both points.
Results check_cells(const CheckContext& context)
{
    constexpr std::uint32_t BLOCKS = 5;
    Words samples(BLOCKS * SAMPLES_PER_BLOCK);
    for (std::uint32_t i = 0; i < samples.size(); ++i) samples[i] = i;
    Violations violations;
    for (const Place& place : places()) {
        violations.set_subject(fmt::format("pixel {}, dimension {}", place.pixel, place.dimension));
        for (const Points& p : points(context, SAMPLER_STRATIFIED, 1, place, samples))
            for (std::size_t block = 0; block < BLOCKS; ++block)
                violations.expect(fills_intervals(p, block * SAMPLES_PER_BLOCK, 6, 3), "an empty cell");
    }
    return {violations.result("stratified-cells")};
}

// A number of a sample: which word of which block, told from the pixel and the sample at hand.
struct NumberChoice {
    std::uint32_t word = 0, dimension = 0;
    std::uint32_t pixels_on = 0, samples_on = 0;
    std::uint32_t sample_high = 0, seed_on = 0;
};

// Numbers that nothing may tie to the first word of dimension 0 of the same sample of the same pixel.
const std::vector<std::pair<const char*, NumberChoice>>& other_numbers()
{
    static const std::vector<std::pair<const char*, NumberChoice>> all{
        {"the second word of the point", {.word = 1}},
        {"the block's second point", {.word = 2}},
        {"the last word of the block", {.word = 3}},
        {"the next dimension", {.dimension = 1}},
        {"the second word of the next dimension", {.word = 1, .dimension = 1}},
        {"the next vertex", {.dimension = 1024}},
        {"a vertex deep in the path", {.dimension = 1024u * 128u}},
        {"the next pixel", {.pixels_on = 1}},
        {"a pixel far away", {.pixels_on = 1u << 20}},
        {"the other replicate", {.samples_on = SAMPLES_PER_BLOCK}},
        {"2^32 samples later", {.sample_high = 1}},
        {"the next seed", {.seed_on = 1}}};
    return all;
}

// One number of each sample of some pixels, as a deviation from 1/2 in standard deviations.
std::vector<float> numbers_of(const CheckContext& context, std::uint32_t sampler, const NumberChoice& choice,
                              std::uint32_t first_pixel, std::uint32_t pixel_count)
{
    Words pixels, samples;
    for (std::uint32_t p = first_pixel; p < first_pixel + pixel_count; ++p)
        for (std::uint32_t s = 0; s < SAMPLES_PER_BLOCK; ++s) {
            pixels.push_back(2 * p + choice.pixels_on);
            samples.push_back(s + choice.samples_on);
        }
    Words from = stream(context, sampler, 2, choice.sample_high);
    from[0] += choice.seed_on;
    const Words words = blocks(context, from, pixels, samples, Words(pixels.size(), choice.dimension))[choice.word];
    std::vector<float> numbers;
    for (const std::uint32_t word : words)
        numbers.push_back(static_cast<float>((word * 0x1p-32 - 0.5) * std::sqrt(12.0)));
    return numbers;
}

// Correlation coefficients over the samples of each pixel. Samples of a pixel depend on each other: pixels are the
// independent trials.
Results check_correlation(const CheckContext& context, std::uint32_t sampler, const std::string& name)
{
    constexpr std::uint32_t BATCH = 1 << 12;
    const auto batches = static_cast<std::uint32_t>(std::ceil(16 * context.effort));
    std::vector<RunningStatistics> correlations(other_numbers().size());
    for (std::uint32_t batch = 0; batch < batches && !context.stop(); ++batch) {
        const std::vector<float> first = numbers_of(context, sampler, {}, batch * BATCH, BATCH);
        for (std::size_t k = 0; k < correlations.size(); ++k) {
            const std::vector<float> other =
                numbers_of(context, sampler, other_numbers()[k].second, batch * BATCH, BATCH);
            for (std::size_t i = 0; i < first.size(); i += SAMPLES_PER_BLOCK)
                correlations[k].add(
                    std::inner_product(first.data() + i, first.data() + i + SAMPLES_PER_BLOCK, other.data() + i, 0.0) /
                    SAMPLES_PER_BLOCK);
        }
    }
    ExpectedMeans tests(context);
    for (std::size_t k = 0; k < correlations.size(); ++k) // from 1, so that what could have been seen is a correlation
        tests.add(other_numbers()[k].first, 1 + correlations[k].mean(), correlations[k].standard_error(), 1, 1e-7);
    return {tests.result(name)};
}
} // namespace

std::vector<std::uint32_t> samples_of_replicate(std::uint32_t replicate, std::uint32_t replicates, std::uint32_t count)
{
    std::vector<std::uint32_t> samples(count);
    for (std::uint32_t i = 0; i < count; ++i)
        samples[i] = i / SAMPLES_PER_BLOCK * SAMPLES_PER_BLOCK * replicates + replicate * SAMPLES_PER_BLOCK +
                     i % SAMPLES_PER_BLOCK;
    return samples;
}

std::vector<Check> sampler_checks()
{
    std::vector<Check> checks{make_check("sampling", "sobol-nets", check_nets),
                              make_check("sampling", "stratified-cells", check_cells)};
    const auto add_correlation = [&](std::uint32_t sampler, const std::string& name) {
        checks.push_back(make_check(
            "sampling", name, [=](const CheckContext& context) { return check_correlation(context, sampler, name); },
            other_numbers().size()));
    };
#define ADD_CORRELATION(NAME, name, text) add_correlation(SAMPLER_##NAME, #name "-correlation");
    SAMPLER_LIST(ADD_CORRELATION)
#undef ADD_CORRELATION
    return checks;
}
} // namespace etendue
