// Passes and units: every sample of every pixel once, never across the end of a block.
#include "render/schedule.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <thread>
#include <vector>

using namespace etendue;

namespace
{
// How often the units of a pass cover each pixel of the crop; checks what every unit must obey.
std::vector<int> coverage(const PixelRect& crop, const std::vector<WorkUnit>& units, const Pass& pass)
{
    std::vector<int> count(static_cast<std::size_t>(crop.width * crop.height), 0);
    for (const WorkUnit& unit : units) {
        REQUIRE(unit.tile_width > 0);
        REQUIRE(unit.tile_height > 0);
        CHECK(unit.sample_count == pass.sample_count);
        CHECK((std::uint64_t{unit.first_sample_high} << 32 | unit.first_sample) == pass.first_sample);
        CHECK(unit.pool_size == 0);
        for (std::uint32_t y = unit.tile_y; y < unit.tile_y + unit.tile_height; ++y)
            for (std::uint32_t x = unit.tile_x; x < unit.tile_x + unit.tile_width; ++x) {
                const int column = static_cast<int>(x) - crop.x, row = static_cast<int>(y) - crop.y;
                REQUIRE((column >= 0 && column < crop.width && row >= 0 && row < crop.height));
                ++count[static_cast<std::size_t>(row * crop.width + column)];
            }
    }
    return count;
}

bool all_once(const std::vector<int>& count)
{
    return std::all_of(count.begin(), count.end(), [](int n) { return n == 1; });
}

const PixelRect CROPS[] = {{0, 0, 1, 1},    {5, 3, 1, 1},    {0, 0, 100, 1},      {7, 2, 1, 100},
                           {3, 11, 13, 17}, {0, 0, 640, 20}, {65535, 65535, 1, 1}};
} // namespace

TEST_CASE("the units of a pass cover every pixel exactly once, whatever their size")
{
    for (const PixelRect& crop : CROPS)
        for (const std::uint32_t max_samples : {1u, 63u, 64u, 100u, 1000u, 1u << 19, ~0u})
            for (const std::uint32_t sample_count : {1u, 3u, 64u}) {
                const Pass pass{128, sample_count};
                Schedule schedule(crop, pass);
                std::vector<WorkUnit> units;
                while (const auto unit = schedule.next(max_samples)) {
                    // At least one pixel, and no more than may be launched.
                    const std::uint64_t samples =
                        std::uint64_t{unit->tile_width} * unit->tile_height * unit->sample_count;
                    CHECK(samples <= std::max<std::uint64_t>(max_samples, sample_count));
                    units.push_back(*unit);
                }
                INFO(crop.width << 'x' << crop.height << ", " << max_samples << " samples a launch");
                CHECK(all_once(coverage(crop, units, pass)));
                CHECK_FALSE(schedule.next(max_samples));
            }
}

TEST_CASE("units fit together when their size changes from one to the next")
{
    std::mt19937 random(4);
    for (const PixelRect& crop : CROPS) {
        const Pass pass{std::uint64_t{5} << 33, 2};
        Schedule schedule(crop, pass);
        std::vector<WorkUnit> units;
        while (const auto unit = schedule.next(1u << random() % 14)) units.push_back(*unit);
        CHECK(all_once(coverage(crop, units, pass)));
    }
}

TEST_CASE("several threads share a pass without a gap or a double")
{
    const PixelRect crop{2, 3, 97, 53};
    const Pass pass{0, 4};
    Schedule schedule(crop, pass);
    std::vector<std::vector<WorkUnit>> taken(4);
    std::vector<std::thread> threads;
    for (auto& units : taken)
        threads.emplace_back([&] {
            while (const auto unit = schedule.next(28)) units.push_back(*unit);
        });
    for (std::thread& thread : threads) thread.join();
    std::vector<WorkUnit> all;
    for (const auto& units : taken) all.insert(all.end(), units.begin(), units.end());
    CHECK(all_once(coverage(crop, all, pass)));
}

TEST_CASE("a pass has a unit for each device, even if one could do it all")
{
    for (const PixelRect& crop : CROPS)
        for (const std::size_t devices : {1u, 2u, 3u, 7u}) {
            const Pass pass{0, 1};
            Schedule schedule(crop, pass, devices);
            std::vector<WorkUnit> units;
            while (const auto unit = schedule.next(~0u)) units.push_back(*unit);
            CHECK(all_once(coverage(crop, units, pass)));
            CHECK(units.size() >= std::min<std::size_t>(devices, static_cast<std::size_t>(crop.width * crop.height)));
        }
}

TEST_CASE("a cancelled pass hands out nothing more")
{
    Schedule schedule({0, 0, 10, 10}, {0, 1});
    REQUIRE(schedule.next(7));
    schedule.cancel();
    CHECK_FALSE(schedule.next(7));
}

TEST_CASE("the largest film is cut without overflow")
{
    // 2^32 pixels: 65535 rows fit into a launch of 2^32 - 1 samples, and one is left.
    Schedule schedule({0, 0, 65536, 65536}, {0, 1});
    const auto most = schedule.next(~0u), rest = schedule.next(~0u);
    REQUIRE(most);
    CHECK((most->tile_y == 0 && most->tile_width == 65536 && most->tile_height == 65535));
    REQUIRE(rest);
    CHECK((rest->tile_y == 65535 && rest->tile_width == 65536 && rest->tile_height == 1));
    CHECK_FALSE(schedule.next(~0u));
}

TEST_CASE("passes double up to the first block, then take block by block")
{
    std::vector<std::uint32_t> counts;
    for (std::uint64_t done = 0; done < 200; done += counts.back()) counts.push_back(next_pass(done, 200).sample_count);
    CHECK(counts == std::vector<std::uint32_t>{1, 1, 2, 4, 8, 16, 32, 64, 64, 8});
}

TEST_CASE("passes add up to the total and never cross the end of a block, from wherever they go on")
{
    for (const std::uint64_t start : {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{61}, std::uint64_t{64},
                                      std::uint64_t{100}, (std::uint64_t{1} << 32) - 5, std::uint64_t{1} << 50})
        for (const std::uint64_t length : {1u, 2u, 63u, 64u, 65u, 300u}) {
            std::uint64_t done = start;
            while (done < start + length) {
                const Pass pass = next_pass(done, start + length);
                REQUIRE(pass.first_sample == done);
                REQUIRE(pass.sample_count > 0);
                CHECK(done / SAMPLES_PER_BLOCK == (done + pass.sample_count - 1) / SAMPLES_PER_BLOCK);
                done += pass.sample_count;
            }
            CHECK(done == start + length);
        }
}
