// The checks of sampling find what is planted; that it is sound is what `etendue check all`, run by ctest, is for.
#include "check/sampling_checks.h"

#include "support/device_checks.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("a round too few is not Philox")
{
    CHECK(failures_with_bug(sampling_checks(), "philox", "sampling/random.h", "round < 10", "round < 9") ==
          Names{"philox"});
}

TEST_CASE("numbers that do not depend on the sample repeat and correlate")
{
    CHECK(failures_with_bug(sampling_checks(), "philox", "sampling/random.h", "philox(stream.pixel, stream.sample,",
                            "philox(stream.pixel, (Uint)(0u),") ==
          Names{"philox-correlation", "philox-neighbours", "philox-repeats"});
}

TEST_CASE("a map that leaves its hemisphere is found")
{
    CHECK(failures_with_bug(sampling_checks(), "warps", "sampling/warp.h", "Float z = 1.0 - v;",
                            "Float z = 0.999 - v;") == Names{"warps"});
}

TEST_CASE("a choice that is out by one integer is found")
{
    CHECK(failures_with_bug(sampling_checks(), "alias", "sampling/distribution.h", "entry_bits < threshold",
                            "entry_bits <= threshold") == Names{"alias-table"});
}

TEST_CASE("a frame that turns over near a pole is found")
{
    CHECK(failures_with_bug(sampling_checks(), "frames", "math/frame.h", "-1.0 / (sign + n.z)", "-1.0 / (1.0 + n.z)") ==
          Names{"frames-orthonormal", "frames-handedness"});
}

TEST_CASE("squares of densities that overflow are found")
{
    CHECK(failures_with_bug(sampling_checks(), "mis", "sampling/mis.h", "1.0 / (1.0 + square(b / a))",
                            "square(a) / (square(a) + square(b))") == Names{"mis-weights"});
}
