// The checks of a device find what is planted; that a sound one passes is what `etendue check all`, run by ctest, is
// for.
#include "check/device_checks.h"

#include "support/device_checks.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("a constant with a digit wrong is found")
{
    CHECK(failures_with_bug(device_checks(), "device-log", "math/elementary.h", "3.3333331174e-1", "3.3333931174e-1") ==
          Names{"device-log", "device-log-near-1"});
}

TEST_CASE("a sine with a coefficient wrong is found")
{
    CHECK(failures_with_bug(device_checks(), "device-sin", "math/elementary.h", "-1.6666654611e-1",
                            "-1.6666754611e-1") == Names{"device-sin-cos"});
}

TEST_CASE("other random numbers are other bits")
{
    CHECK(failures_with_bug(device_checks(), "device-bits-philox", "sampling/random.h", "0x9E3779B9u", "0x9E3779B8u") ==
          Names{"device-bits-philox"});
}
