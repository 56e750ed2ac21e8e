// The checks of samplers find what is planted; that sound ones pass is what `etendue check all`, run by ctest, is for.
#include "check/sampling_checks.h"
#include "support/device_checks.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("digits of the second component that are not summed leave intervals empty")
{
    CHECK(failures_with_bug(sampler_checks(), "sobol-nets", "sampling/sobol.h", "index ^= (index >> 2) & 0x33333333u;",
                            "") == Names{"sobol-nets"});
}

TEST_CASE("a stratum whose order is no permutation leaves cells empty")
{
    CHECK(failures_with_bug(sampler_checks(), "stratified-cells", "sampling/stratified.h", "(bits_a | 1u)",
                            "(bits_a | 2u)") == Names{"stratified-cells"});
}
