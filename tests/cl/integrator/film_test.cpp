// Sums of one pixel's block against double, as the device adds them.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace etendue;

namespace
{
// Adds the samples in0[0..63] of one block; element i takes the first i + 1 of them.
const DeviceFunctions FILM({"integrator/film.h"},
                           {{"block", "Value* uint -> float float float float",
                             R"(
    UintLanes counts; counts.lanes = in1;
    FloatLanes sum, compensation, m2, n;
    for (int lane = 0; lane < LANES; lane++) {
        PixelBlock block;
        block.sum = block.compensation = block.m2 = (real4)(0.0);
        for (uint s = 0; s < counts.lane[lane]; s++) block = block_add(block, in0[s].v);
        sum.lane[lane] = block.sum.y; compensation.lane[lane] = block.compensation.y;
        m2.lane[lane] = block.m2.y; n.lane[lane] = block.sum.w;
    }
    out0 = sum.lanes; out1 = compensation.lanes; out2 = m2.lanes; out3 = n.lanes;)"}},
                           "typedef struct Value { real4 v; } Value;\n");

struct Value {
    real4 v;
};

struct Sums {
    double mean, m2, n;
};

Sums block_of(const Device& device, const std::vector<float>& samples)
{
    std::vector<Value> values;
    for (const float x : samples) values.push_back({make_real4(1, x, 2)});
    const DeviceResults r =
        FILM.evaluate(device, "block", {values, std::vector<std::uint32_t>{static_cast<uint>(samples.size())}}, 1);
    const double sum = static_cast<double>(r.get<float>(0)[0]) - r.get<float>(1)[0];
    return {sum / static_cast<double>(samples.size()), r.get<float>(2)[0], r.get<float>(3)[0]};
}
} // namespace

TEST_CASE("a block of equal samples has their value as mean and no variance", "[kernel]")
{
    for (const Device& device : test_devices())
        for (const float x : {0.1f, 1e-8f, 1e8f, 3.0f})
            for (const std::size_t count : {1u, 2u, 63u, 64u}) {
                const Sums sums = block_of(device, std::vector<float>(count, x));
                CHECK(sums.n == static_cast<double>(count));
                CHECK(std::abs(sums.mean - x) <= 0x1p-23 * x);
                CHECK(sums.m2 >= 0.0);
                CHECK(sums.m2 <= 64 * 0x1p-46 * x * x);
            }
}

TEST_CASE("a block keeps mean and variance far from zero and among spikes", "[kernel]")
{
    std::mt19937 random(4);
    std::normal_distribution<double> normal(1000.0, 0.1);
    for (const Device& device : test_devices())
        for (int round = 0; round < 20; ++round) {
            std::vector<float> samples;
            for (int i = 0; i < 64; ++i) samples.push_back(static_cast<float>(normal(random)));
            if (round % 4 == 3) samples[static_cast<std::size_t>(round)] = 1e6f;
            long double sum = 0, m2 = 0;
            for (const float x : samples) sum += x;
            for (const float x : samples) m2 += (x - sum / 64) * (x - sum / 64);
            const Sums found = block_of(device, samples);
            CHECK(std::abs(found.mean - static_cast<double>(sum / 64)) <= 0x1p-23 * static_cast<double>(sum / 64));
            // The mean so far is rounded to 6e-5 at 1000, beside deviations of 0.1.
            CHECK(found.m2 == Approx(static_cast<double>(m2)).epsilon(2e-3));
        }
}
