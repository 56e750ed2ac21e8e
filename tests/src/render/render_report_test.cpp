// Sums over a report.
#include "render/render_report.h"

#include <catch2/catch.hpp>

#include <set>

using namespace etendue;

TEST_CASE("rays are those of all kinds, accidents those of all kinds")
{
    RenderReport report;
    CHECK(report.rays() == 0);
    CHECK(report.accidents() == 0);
    report.counts[COUNT_CAMERA_RAYS] = 1000;
    report.counts[COUNT_INDIRECT_RAYS] = std::uint64_t{1} << 40;
    report.counts[COUNT_SHADOW_RAYS] = 30;
    report.counts[COUNT_BUSY_LANES] = 7;
    CHECK(report.rays() == (std::uint64_t{1} << 40) + 1030);
    report.health[HEALTH_NEGATIVE_PDF].count = 2;
    report.health[HEALTH_PATH_TOO_LONG].count = 5;
    CHECK(report.accidents() == 7);
}

TEST_CASE("busy lanes are a share of all slots, and everything when nothing ran")
{
    RenderReport report;
    CHECK(report.busy_lanes() == 1.0);
    report.counts[COUNT_BUSY_LANES] = 30;
    report.counts[COUNT_LANE_SLOTS] = 40;
    CHECK(report.busy_lanes() == 0.75);
}

TEST_CASE("rays per second leave out the first launches")
{
    RenderReport report;
    report.counts[COUNT_CAMERA_RAYS] = 3000;
    CHECK(report.rays_per_second() == 0.0);
    DeviceReport device;
    device.samples = 300;
    device.first_launch_samples = 100;
    report.devices = {device};
    report.render_seconds = 5.0;
    report.first_launch_seconds = 3.0;
    // Two thirds of the samples and so of the rays, in two seconds.
    CHECK(report.rays_per_second() == Approx(1000.0));
    // When there was nothing but first launches, they count.
    report.devices[0].first_launch_samples = 300;
    CHECK(report.rays_per_second() == Approx(600.0));
}

TEST_CASE("every kind of accident has a name of its own")
{
    std::set<std::string> names;
    for (std::size_t kind = 0; kind < HEALTH_KINDS; ++kind) names.insert(health_name(kind));
    CHECK(names.size() == HEALTH_KINDS);
    CHECK(std::string(health_name(HEALTH_NON_FINITE_RADIANCE)) == "non_finite_radiance");
    CHECK(std::string(health_name(HEALTH_INVALID_RAY)) == "invalid_ray");
    CHECK(std::string(health_name(HEALTH_STACK_OVERFLOW)) == "stack_overflow");
    CHECK(std::string(health_name(HEALTH_PATH_TOO_LONG)) == "path_too_long");
    CHECK_THROWS_AS(health_name(HEALTH_KINDS), std::out_of_range);
}
