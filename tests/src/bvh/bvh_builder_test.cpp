// Host, device or whichever is ready first: the same tree.
#include "bvh/bvh_builder.h"

#include "bvh/bvh_check.h"
#include "bvh/lbvh_host.h"
#include "check/primitive_sets.h"
#include "support/device_evaluate.h"
#include "util/error.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace etendue
{
TEST_CASE("automatic means the host for few primitives, the others mean themselves")
{
    CHECK(choose_bvh_place(BvhPlace::automatic, 0) == BvhPlace::host);
    CHECK(choose_bvh_place(BvhPlace::automatic, AUTOMATIC_DEVICE_THRESHOLD - 1) == BvhPlace::host);
    CHECK(choose_bvh_place(BvhPlace::automatic, AUTOMATIC_DEVICE_THRESHOLD) == BvhPlace::device);
    CHECK(choose_bvh_place(BvhPlace::device, 0) == BvhPlace::device);
    CHECK(choose_bvh_place(BvhPlace::host, 0xffffffffu) == BvhPlace::host);
}

TEST_CASE("each place builds a valid tree and says where it was")
{
    const std::vector<Primitive> set = random_triangles(500);
    for (const Device& device : test_devices()) {
        const Buffer<Primitive> primitives(device, "primitives", set);
        for (const BvhPlace place : {BvhPlace::host, BvhPlace::device, BvhPlace::automatic}) {
            const BvhBuild build = build_bvh(place, device, KernelCache::none(), set, primitives);
            CHECK(check_bvh(download(build.bvh), set) == std::vector<std::string>{});
            CHECK(build.warning.empty());
            CHECK(build.bvh.statistics.built_on_device == (place == BvhPlace::device));
            CHECK((build.builder != nullptr) == (place == BvhPlace::device));
        }
    }
}

TEST_CASE("where kernels fail, automatic builds on the host and says so, and device is an error")
{
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "etendue_broken_kernels";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "bvh_build.cl") << "this is no kernel\n";
    const std::vector<Primitive> set = random_triangles(50);
    for (const Device& device : test_devices()) {
        const Buffer<Primitive> primitives(device, "primitives", set);
        const auto build = [&](BvhPlace place) {
            return build_bvh(place, device, KernelCache::none(), set, primitives, 10);
        };
        const char* before = std::getenv("ETENDUE_CL_DIR");
        const std::string restored = before ? before : "";
        setenv("ETENDUE_CL_DIR", folder.c_str(), 1);
        BvhBuild result;
        CHECK_NOTHROW(result = build(BvhPlace::automatic));
        CHECK_THROWS_AS(build(BvhPlace::device), BuildError);
        before ? setenv("ETENDUE_CL_DIR", restored.c_str(), 1) : unsetenv("ETENDUE_CL_DIR");

        CHECK(result.warning.find("The tree is built on the host, because the device failed: bvh_build.cl") == 0);
        CHECK(check_bvh(download(result.bvh), set) == std::vector<std::string>{});
        CHECK(build(BvhPlace::automatic).warning.empty());
    }
    std::filesystem::remove_all(folder);
}
} // namespace etendue
