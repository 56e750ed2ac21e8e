// Samplers more even than chance: nets counted interval by interval, cells counted one by one.
#include "check/device_functions.h"
#include "check/findings.h"
#include "check/sampling_checks.h"

#include <array>

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

// The two points of each sample's block: two lists.
std::array<Points, 2> points(const CheckContext& context, std::uint32_t sampler, std::uint32_t replicates,
                             const Place& place, const Words& samples)
{
    const Words stream{static_cast<std::uint32_t>(context.seed) + 7u, static_cast<std::uint32_t>(context.seed >> 32),
                       place.sample_high, sampler, replicates};
    const auto out =
        functions()
            .evaluate(*context.device, "block",
                      {stream, Words(samples.size(), place.pixel), samples, Words(samples.size(), place.dimension)},
                      context.lanes)
            .outputs;
    std::array<Points, 2> pairs;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t pair = 0; pair < 2; ++pair) pairs[pair].push_back({out[2 * pair][i], out[2 * pair + 1][i]});
    return pairs;
}

// The samples whose places in the sequence of a replicate are 0, 1, ..., count - 1.
Words samples_of_replicate(std::uint32_t replicate, std::uint32_t replicates, std::uint32_t count)
{
    Words samples(count);
    for (std::uint32_t i = 0; i < count; ++i)
        samples[i] = i / SAMPLES_PER_BLOCK * SAMPLES_PER_BLOCK * replicates + replicate * SAMPLES_PER_BLOCK +
                     i % SAMPLES_PER_BLOCK;
    return samples;
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
} // namespace

std::vector<Check> sampler_checks()
{
    return {make_check("sampling", "sobol-nets", check_nets), make_check("sampling", "stratified-cells", check_cells)};
}
} // namespace etendue
