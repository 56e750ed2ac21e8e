// The checks of trees and rays find what is planted; that sound ones pass is what `etendue check all`, run by ctest, is
// for.
#include "check/bvh_checks.h"

#include "support/device_checks.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("boxes that let rays slip by are found")
{
    CHECK(failures_with_bug(bvh_checks(), "traversal", "geometry/box.h", "enter <= leave * SLAB_FAR_FACTOR",
                            "enter * 1.01 <= leave") == Names{"traversal"});
}

TEST_CASE("edges that belong to no triangle let rays out of closed meshes")
{
    CHECK(failures_with_bug(bvh_checks(), "watertight", "geometry/triangle.h", "(u >= 0.0) & (v >= 0.0) & (w >= 0.0)",
                            "(u > 0.0) & (v > 0.0) & (w > 0.0)") ==
          Names{"watertight-at-origin", "watertight-at-1e5", "watertight-at-embree-offset"});
}

TEST_CASE("a point that is not moved off its surface meets it again")
{
    CHECK(failures_with_bug(bvh_checks(), "grazing", "geometry/ray_offset.h", "fma3(surface.ng, distance, surface.p)",
                            "surface.p") == Names{"grazing-self-hits"});
}

TEST_CASE("origins moved by an absolute distance leak through sheets close by")
{
    CHECK(failures_with_bug(bvh_checks(), "parallel", "geometry/ray_offset.h", "fma3(surface.ng, distance, surface.p)",
                            "fma3(surface.ng, outward ? (Float)(0.0005) : (Float)(-0.0005), surface.p)") ==
          Names{"parallel-sheets"});
}

TEST_CASE("keys in another order are found, and so is the tree of them")
{
    CHECK(failures_with_bug(bvh_checks(), "bvh-", "algorithm/radix_sort.h", "sorted_values[place] = values[i];",
                            "sorted_values[place] = values[first];") == Names{"bvh-device-tree", "bvh-sort"});
}
