// Which samples a work-item traces: all of them together trace each one once, whatever the sizes.
#include "compute/kernel.h"
#include "support/device_evaluate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

namespace etendue
{
namespace
{
const char* KERNELS = R"(
#include "integrator/work.h"

/* Take samples for lanes that fall idle now and then, until none is left; count each index taken. `faults` counts lanes
 * that got an index without being idle, and lanes of one index. */
kernel void take_all(WorkUnit unit, uint item_count, uint seed, global uint* counts, global uint* faults)
{
    uint item = (uint)get_global_id(0);
    if (item >= item_count) return;
    SamplePool pool = make_sample_pool(unit, item);
    Uint index = (Uint)(NO_INDEX);
    uint before = pool.next;
    for (uint step = 0u; step < 100000u; step++) {
        RandomBlock random = philox((Uint)(step), lane_numbers(), (Uint)(item), (Uint)(0u), seed, 0u);
        Mask idle = (random.x & 3u) == 0u;
        Uint old = index;
        Mask fresh = take_samples(&pool, idle, &index);
        UintLanes taken;
        taken.lanes = fresh ? index : (Uint)(NO_INDEX);
        if (any_of(not(idle) & (fresh | (index != old)))) atomic_inc(faults);
        for (uint lane = 0u; lane < LANES; lane++)
            if (taken.lane[lane] != NO_INDEX) {
                if (taken.lane[lane] != before) atomic_inc(faults);
                before = taken.lane[lane] + 1u;
                atomic_inc(counts + taken.lane[lane]);
            }
        if (pool.next >= pool.end && any_of(idle)) break;
    }
}

kernel void place(SCENE_ARGUMENTS, WorkUnit unit, uint count, global uint4* places)
{
    SceneView view = SCENE_VIEW();
    uint first = (uint)get_global_id(0) * LANES;
    UintLanes index, x_lanes, y_lanes, pixel, sample;
    for (uint lane = 0u; lane < LANES; lane++) index.lane[lane] = min(first + lane, count - 1u);
    Uint x, y;
    RandomStream stream;
    place_sample(view, unit, index.lanes, &x, &y, &stream);
    x_lanes.lanes = x;
    y_lanes.lanes = y;
    pixel.lanes = stream.pixel;
    sample.lanes = stream.sample;
    for (uint lane = 0u; lane < LANES; lane++)
        if (first + lane < count)
            places[first + lane] = (uint4)(x_lanes.lane[lane], y_lanes.lane[lane], pixel.lane[lane], sample.lane[lane]);
    if (first == 0u) places[count] = (uint4)(stream.key_low, stream.key_high, stream.sample_high, 0u);
}

/* Every work-item adds the same counts. */
kernel void add_all(global LaunchCounters* counters, uint low, uint high)
{
    RayCounts rays;
    for (int kind = 0; kind < COUNT_KINDS; kind++) rays.counts[kind] = 0ul;
    rays.counts[COUNT_SHADOW_RAYS] = (ulong)high << 32 | low;
    rays.counts[COUNT_CAMERA_RAYS] = 1ul;
    add_counts(counters, rays);
}
)";

Program make_program(const Device& device, std::uint32_t lanes)
{
    return Program::from_text(device, "work under test", KERNELS,
                              Specialization::everything(lanes, 32).build_options());
}

WorkUnit unit_of(uint width, uint height, uint samples, uint pool)
{
    WorkUnit unit{};
    unit.tile_width = width;
    unit.tile_height = height;
    unit.sample_count = samples;
    unit.pool_size = pool;
    return unit;
}
} // namespace

TEST_CASE("every sample of a unit is taken exactly once, in order, by lanes that are idle")
{
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Program program = make_program(device, lanes);
            Kernel take(program, "take_all");
            for (const WorkUnit& unit : {unit_of(1, 1, 1, 1), unit_of(13, 7, 5, 1), unit_of(13, 7, 5, 3),
                                         unit_of(13, 7, 5, 17), unit_of(16, 16, 4, 64), unit_of(5, 3, 7, 1000)}) {
                const uint total = unit.tile_width * unit.tile_height * unit.sample_count;
                // A few work-items more than needed.
                const uint items = (total + unit.pool_size - 1) / unit.pool_size + 3;
                const Buffer<uint> counts(device, "counts", std::vector<uint>(total, 0)),
                    faults(device, "faults", std::vector<uint>(1, 0));
                take.run(items, 1, unit, items, unit.pool_size, counts, faults);
                CAPTURE(lanes, total, unit.pool_size);
                CHECK(counts.read() == std::vector<uint>(total, 1));
                CHECK(faults.read() == std::vector<uint>{0});
            }
        }
}

TEST_CASE("a flat index is placed by sample, row and column of the tile, with the film's pixel as its random stream")
{
    RenderSettings settings{};
    settings.width = 640;
    settings.height = 480;
    settings.seed_low = 17;
    settings.seed_high = 19;
    WorkUnit unit = unit_of(13, 7, 5, 1);
    unit.tile_x = 600;
    unit.tile_y = 400;
    unit.first_sample = 0xfffffff0u;
    unit.first_sample_high = 3;
    const uint total = 13 * 7 * 5;
    const Buffer<uint> none;
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Program program = make_program(device, lanes);
            const Buffer<uint4> places(device, "places", total + 1);
            Kernel(program, "place")
                .run((total + lanes - 1) / lanes, 1, Buffer<RenderSettings>(device, "settings", {settings}), none, none,
                     none, none, none, none, none, none, none, unit, total, places);
            const std::vector<uint4> found = places.read();
            std::size_t i = 0, wrong = 0;
            for (uint sample = 0; sample < 5; ++sample)
                for (uint row = 0; row < 7; ++row)
                    for (uint column = 0; column < 13; ++column, ++i) {
                        const uint x = 600 + column, y = 400 + row;
                        const uint4 expected{{x, y, y * 640 + x, 0xfffffff0u + sample}};
                        wrong += std::memcmp(&found[i], &expected, sizeof expected) != 0;
                    }
            CHECK(wrong == 0);
            CHECK(found[total].s[0] == 17);
            CHECK(found[total].s[1] == 19);
            CHECK(found[total].s[2] == 3);
        }
}

TEST_CASE("counts of work-items add up beyond 32 bits")
{
    constexpr uint ITEMS = 1000, LOW = 0xfffffff1u, HIGH = 2;
    for (const Device& device : test_devices()) {
        const Buffer<LaunchCounters> counters(device, "counters", {LaunchCounters{}});
        Kernel(make_program(device, 1), "add_all").run(ITEMS, 1, counters, LOW, HIGH);
        const LaunchCounters found = counters.read().front();
        const auto total = [&](int kind) {
            return (std::uint64_t{found.counts_high[kind]} << 32) + found.counts[kind];
        };
        CHECK(total(COUNT_SHADOW_RAYS) == ITEMS * ((std::uint64_t{HIGH} << 32) + LOW));
        CHECK(total(COUNT_CAMERA_RAYS) == ITEMS);
        CHECK(total(COUNT_INDIRECT_RAYS) == 0);
    }
}
} // namespace etendue
