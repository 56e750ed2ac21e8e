// Every sampler by the way paths call it: words are uniform, streams are independent, and nothing repeats.
#include "support/chi_square.h"
#include "support/device_lanes.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>
#include <set>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"sampling/sampler.h"},
    {
        // key low, key high, sample high, sampler, replicates; pixel, sample, dimension
        {"block", "uint* uint uint uint -> uint uint uint uint",
         "RandomStream s = {in0[0], in0[1], in0[2], in1, in2, in0[3], in0[4]};"
         "RandomBlock b = sampler_block(s, in3); out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
        {"by_hand", "uint* uint uint uint -> uint uint uint uint",
         "RandomStream s = {in0[0], in0[1], in0[2], in1, in2, in0[3], in0[4]}; RandomBlock b = random_block(s, in3);"
         "if (s.sampler == SAMPLER_STRATIFIED) b = stratified_block(s, in3);"
         "if (s.sampler == SAMPLER_SOBOL) b = sobol_block(s, in3);"
         "out0 = b.x; out1 = b.y; out2 = b.z; out3 = b.w;"},
    });

using Words = std::vector<std::uint32_t>;

struct Sampler {
    std::string name;
    std::uint32_t number, replicates;
};
const Sampler SAMPLERS[] = {{"independent", SAMPLER_INDEPENDENT, 1},
                            {"stratified", SAMPLER_STRATIFIED, 1},
                            {"sobol", SAMPLER_SOBOL, 1},
                            {"sobol with two replicates", SAMPLER_SOBOL, 2}};

Words stream(const Sampler& sampler, std::uint32_t seed, std::uint32_t sample_high = 0)
{
    return {seed, 0, sample_high, sampler.number, sampler.replicates};
}

// The four words of a sample and a dimension at pixels first, first + 1, ...
std::vector<Words> across_pixels(const Device& device, const Words& stream, std::uint32_t first, std::uint32_t count,
                                 std::uint32_t sample, std::uint32_t dimension)
{
    Words pixel(count);
    for (std::uint32_t i = 0; i < count; ++i) pixel[i] = first + i;
    return functions.evaluate(device, "block", {stream, pixel, Words(count, sample), Words(count, dimension)}).outputs;
}

double unit(std::uint32_t bits)
{
    return bits * 0x1p-32;
}
} // namespace

TEST_CASE("a stream draws from the sampler that it names, the same bits in every number of lanes")
{
    std::mt19937 random(3);
    std::vector<Words> words(3, Words(4096));
    for (Words& w : words)
        for (std::uint32_t& word : w) word = static_cast<std::uint32_t>(random());
    for (Device& device : test_devices()) {
        std::set<Words> seen;
        for (const Sampler& sampler : SAMPLERS) {
            INFO(sampler.name);
            const Words s = stream(sampler, 11, 5);
            const auto out =
                evaluate_in_all_lanes(functions, device, "block", {s, words[0], words[1], words[2]}).outputs;
            CHECK(out == functions.evaluate(device, "by_hand", {s, words[0], words[1], words[2]}).outputs);
            seen.insert(out[0]);
        }
        CHECK(seen.size() == std::size(SAMPLERS));
    }
}

TEST_CASE("across pixels the words of a sample are uniform, alone and in pairs")
{
    constexpr std::uint32_t PIXELS = 1 << 18;
    for (Device& device : test_devices())
        for (const Sampler& sampler : SAMPLERS)
            for (const std::uint32_t sample : {0u, 37u, 100064u}) {
                const auto out = across_pixels(device, stream(sampler, 5), 0, PIXELS, sample, 3);
                for (const auto& [a, b] : {std::pair{0, 1}, {2, 3}, {0, 2}, {1, 3}}) {
                    Histogram pairs(16, 16);
                    for (std::size_t i = 0; i < PIXELS; ++i)
                        pairs.add(unit(out[static_cast<std::size_t>(a)][i]), unit(out[static_cast<std::size_t>(b)][i]));
                    check_histogram(sampler.name + ": words " + std::to_string(a) + " and " + std::to_string(b) +
                                        " of sample " + std::to_string(sample),
                                    pairs, std::vector<double>(256, 1.0 / 256), 0.03);
                }
                // The bits that 256 bins do not see.
                std::array<double, 32> ones{};
                for (const std::uint32_t word : out[3])
                    for (std::size_t bit = 0; bit < 32; ++bit) ones[bit] += word >> bit & 1u;
                for (std::size_t bit = 0; bit < 32; ++bit) {
                    CAPTURE(sampler.name, sample, bit);
                    CHECK(std::abs(ones[bit] - 0.5 * PIXELS) < 5.0 * std::sqrt(0.25 * PIXELS));
                }
            }
}

TEST_CASE("neighbouring pixels, dimensions, seeds, words and huge samples draw independently")
{
    // 4096 draws each, one a pixel: of so many independent streams the largest correlation stays below the limit.
    constexpr std::uint32_t DRAWS = 4096, STREAMS = 256;
    for (Device& device : test_devices())
        for (const Sampler& sampler : SAMPLERS) {
            std::vector<std::vector<float>> streams;
            const auto add = [&](const Words& words_stream, std::uint32_t first_pixel, std::uint32_t dimension) {
                for (const Words& words : across_pixels(device, words_stream, first_pixel, DRAWS, 5, dimension)) {
                    std::vector<float> values(DRAWS);
                    for (std::size_t i = 0; i < DRAWS; ++i)
                        values[i] = static_cast<float>((unit(words[i]) - 0.5) * std::sqrt(12.0));
                    streams.push_back(values);
                }
            };
            for (std::uint32_t dimension = 0; dimension < 24; ++dimension) add(stream(sampler, 1), 0, dimension);
            for (std::uint32_t seed = 2; seed < 18; ++seed) add(stream(sampler, seed), 0, 0);
            for (std::uint32_t shift = 1; shift < 17; ++shift) add(stream(sampler, 1), shift, 0);
            for (std::uint32_t high = 1; high < 9; ++high) add(stream(sampler, 1, high), 0, 0);
            REQUIRE(streams.size() == STREAMS);
            double largest = 0.0;
            for (std::size_t i = 0; i < STREAMS; ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    float sum = 0.0f;
                    for (std::size_t k = 0; k < DRAWS; ++k) sum += streams[i][k] * streams[j][k];
                    largest = std::max(largest, std::abs(static_cast<double>(sum)) / DRAWS);
                }
            const double pairs = STREAMS * (STREAMS - 1.0) / 2.0;
            CAPTURE(sampler.name, largest);
            CHECK(largest < 1.2 * std::sqrt(2.0 * std::log(pairs) / DRAWS));
            CHECK(largest > 0.0);
        }
}

TEST_CASE("samples do not repeat around sample 2^32, nor dimensions beyond 1024")
{
    Words sample, dimension;
    for (const std::uint32_t d : {0u, 1u, 1023u, 1024u, 1025u, 2048u, 65536u, 131073u})
        for (std::uint32_t s = 0; s < 16; ++s) {
            sample.insert(sample.end(), {s, 0xfffffff0u + s});
            dimension.insert(dimension.end(), {d, d});
        }
    const Words pixel(sample.size(), 9);
    for (Device& device : test_devices())
        for (const Sampler& sampler : SAMPLERS) {
            std::set<std::array<std::uint32_t, 2>> firsts, seconds;
            for (const std::uint32_t high : {0u, 1u, 2u, 3u}) {
                const auto out =
                    functions.evaluate(device, "block", {stream(sampler, 1, high), pixel, sample, dimension}).outputs;
                for (std::size_t i = 0; i < sample.size(); ++i) {
                    firsts.insert({out[0][i], out[1][i]});
                    seconds.insert({out[2][i], out[3][i]});
                }
            }
            INFO(sampler.name);
            CHECK(firsts.size() == 4 * sample.size());
            CHECK(seconds.size() == 4 * sample.size());
        }
}
