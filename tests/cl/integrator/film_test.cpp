// Sums of samples against double precision, and the counting of accidents.
#include "compute/kernel.h"
#include "support/device_evaluate.h"
#include "util/statistics.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>

namespace etendue
{
namespace
{
const char* KERNELS = R"(
#include "integrator/film.h"

/* Add samples[0, count) to a block, as one work-item. */
kernel void add_samples(uint count, global const real4* samples, global PixelBlock* blocks)
{
    PixelBlock block = blocks[0];
    for (uint i = 0u; i < count; i++) block = block_add(block, samples[i]);
    blocks[0] = block;
}

kernel void count_accidents(uint count, global const uint* codes, global LaunchCounters* counters)
{
    uint i = (uint)get_global_id(0);
    if (i < count && codes[i] != 0u) count_accident(counters, codes[i], i);
}
)";

class Film
{
public:
    explicit Film(const Device& device)
        : device_(device), program_(Program::from_text(device, "film under test", KERNELS,
                                                       Specialization::everything(1, 32).build_options())),
          add_(program_, "add_samples"), count_(program_, "count_accidents")
    {
    }

    PixelBlock add(const PixelBlock& block, const std::vector<real4>& samples)
    {
        const Buffer<PixelBlock> blocks(device_, "block", {block});
        add_.run(1, 1, static_cast<uint>(samples.size()), Buffer<real4>(device_, "samples", samples), blocks);
        return blocks.read().front();
    }

    LaunchCounters count(const std::vector<uint>& codes)
    {
        LaunchCounters zero{};
        std::fill(std::begin(zero.health_first), std::end(zero.health_first), NO_INDEX);
        const Buffer<LaunchCounters> counters(device_, "counters", {zero});
        count_.run(codes.size(), 0, static_cast<uint>(codes.size()), Buffer<uint>(device_, "codes", codes), counters);
        return counters.read().front();
    }

private:
    const Device& device_;
    Program program_;
    Kernel add_, count_;
};

double sum_of(const PixelBlock& block, int channel)
{
    return double{block.sum.s[channel]} - block.compensation.s[channel];
}

std::vector<real4> normal_samples(std::size_t count, double mean, double deviation)
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal(mean, deviation);
    std::vector<real4> samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back(make_real4(normal(random), 1e-6 * normal(random), 1e6 * normal(random)));
    return samples;
}
} // namespace

TEST_CASE("a million equal samples add up to a million times one, with no variance")
{
    for (const Device& device : test_devices())
        for (const double value : {0.1, 1e-8, 1e8}) {
            const std::vector<real4> samples(1000000, make_real4(value, 2 * value, 0));
            const PixelBlock block = Film(device).add({}, samples);
            const double exact = 1e6 * double{samples[0].s[0]};
            CHECK(block.sum.s[3] == 1000000.0f);
            CHECK(std::abs(sum_of(block, 0) / exact - 1) <= 2 * 0x1p-24);
            CHECK(std::abs(sum_of(block, 1) / (2 * exact) - 1) <= 2 * 0x1p-24);
            CHECK(sum_of(block, 2) == 0);
            CHECK(block.m2.s[0] / 1e6 <= std::pow(1e-6 * value, 2));
            CHECK(block.m2.s[2] == 0.0f);
        }
}

TEST_CASE("sum and variance of samples far from zero are those of double precision")
{
    for (const Device& device : test_devices())
        for (const std::size_t count : {std::size_t{2}, std::size_t{SAMPLES_PER_BLOCK}, std::size_t{100000}}) {
            const std::vector<real4> samples = normal_samples(count, 1000, 0.1);
            const PixelBlock block = Film(device).add({}, samples);
            CAPTURE(count);
            for (int channel = 0; channel < 3; ++channel) {
                double sum = 0;
                RunningStatistics statistics;
                for (const real4& s : samples) {
                    sum += double{s.s[channel]};
                    statistics.add(s.s[channel]);
                }
                CHECK(sum_of(block, channel) == Approx(sum).epsilon(2 * 0x1p-24));
                // A mean that is rounded by u shifts each deviation of 1e-4 by 6e-4 of itself.
                CHECK(block.m2.s[channel] / (static_cast<double>(count) - 1) ==
                      Approx(statistics.variance()).epsilon(2e-3));
            }
            CHECK(block.compensation.s[3] == 0.0f);
            CHECK(block.m2.s[3] == 0.0f);
        }
}

TEST_CASE("a block may be left and continued after any sample without changing a bit")
{
    // A tile of 3 x 2 pixels, each with its own samples, in launches of some of the samples of all pixels.
    constexpr uint PIXELS = 6;
    const std::vector<real4> samples = normal_samples(PIXELS * SAMPLES_PER_BLOCK, 1, 1);
    for (const Device& device : test_devices()) {
        Film film(device);
        const Program program(device, "film.cl", Specialization{}.build_options(), KernelCache::none());
        Kernel accumulate(program, "film_accumulate");
        for (const std::vector<uint>& launches : {std::vector<uint>{64}, {1, 63}, {7, 25, 32}, {63, 1}}) {
            const Buffer<PixelBlock> blocks(device, "blocks", std::vector<PixelBlock>(PIXELS, PixelBlock{}));
            const Buffer<LaunchCounters> counters(device, "counters", std::vector<LaunchCounters>(1));
            const Buffer<SampleAov> no_aovs;
            const Buffer<PixelAov> no_sums;
            auto next = samples.begin();
            for (const uint count : launches) {
                WorkUnit unit{};
                unit.tile_width = 3;
                unit.tile_height = 2;
                unit.sample_count = count;
                const auto end = next + static_cast<std::ptrdiff_t>(count * PIXELS);
                const Buffer<real4> results(device, "results", std::vector<real4>(next, end));
                accumulate.run(PIXELS, 1, unit, results, no_aovs, blocks, no_sums, counters);
                next = end;
            }
            const std::vector<PixelBlock> found = blocks.read();
            for (std::size_t pixel = 0; pixel < PIXELS; ++pixel) {
                std::vector<real4> own;
                for (std::size_t i = pixel; i < samples.size(); i += PIXELS) own.push_back(samples[i]);
                const PixelBlock expected = film.add({}, own);
                CHECK(std::memcmp(&found[pixel], &expected, sizeof expected) == 0);
            }
        }
    }
}

TEST_CASE("the order of the samples moves the sum by no more than its last digit")
{
    std::vector<real4> samples = normal_samples(4096, 100, 10);
    samples[0] = make_real4(1e7, 1e1, 1e13);
    std::vector<real4> rising = samples;
    std::sort(rising.begin(), rising.end(), [](const real4& a, const real4& b) { return a.s[0] < b.s[0]; });
    for (const Device& device : test_devices()) {
        Film film(device);
        const PixelBlock a = film.add({}, samples), b = film.add({}, rising);
        for (int channel = 0; channel < 3; ++channel) {
            CHECK(sum_of(a, channel) == Approx(sum_of(b, channel)).epsilon(0x1p-23));
            CHECK(a.m2.s[channel] == Approx(b.m2.s[channel]).epsilon(1e-5));
        }
    }
}

TEST_CASE("accidents are counted by kind, with the lowest index of each")
{
    std::vector<uint> codes(5000, 0);
    std::vector<uint> counts(HEALTH_KINDS, 0), first(HEALTH_KINDS, NO_INDEX);
    std::mt19937 random(7);
    for (std::size_t i = 100; i < codes.size(); i += 1 + random() % 40) {
        const uint kind = static_cast<uint>(random() % (HEALTH_KINDS - 1)); // the last kind does not happen
        codes[i] = kind + 1 + 16 * static_cast<uint>(random() % 100);
        ++counts[kind];
        first[kind] = std::min(first[kind], static_cast<uint>(i));
    }
    for (const Device& device : test_devices()) {
        const LaunchCounters counters = Film(device).count(codes);
        for (uint kind = 0; kind < HEALTH_KINDS; ++kind) {
            CHECK(counters.health[kind] == counts[kind]);
            CHECK(counters.health_first[kind] == first[kind]);
        }
        CHECK(counters.counts[0] == 0);
    }
}
} // namespace etendue
