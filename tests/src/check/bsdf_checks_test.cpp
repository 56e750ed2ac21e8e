// The checks of BSDFs find what is planted; that sound ones pass is in tests/cl/bsdf.
#include "check/bsdf_checks.h"

#include "support/device_checks.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("a BSDF that reflects half of its albedo does not agree with its own sampling")
{
    for (const auto& [check, result] :
         {std::pair("diffuse-weight", "diffuse-weight"), {"diffuse-integral", "diffuse-integral-albedo"}})
        CHECK(failures_with_bug(bsdf_checks(), check, "bsdf/diffuse.h", "scale3(p.albedo, (Float)(INV_PI))",
                                "scale3(p.albedo, (Float)(INV_TWO_PI))") == Names{result});
}

TEST_CASE("a sampled density that is not pdf() is found")
{
    CHECK(failures_with_bug(bsdf_checks(), "diffuse-weight", "bsdf/diffuse.h", "up.z * INV_PI :", "up.z * 0.3 :") ==
          Names{"diffuse-weight"});
}

TEST_CASE("a density that is not that of the sampling is found by chi-square")
{
    CHECK(failures_with_bug(bsdf_checks(), "diffuse-distribution", "bsdf/diffuse.h", "abs_of(wi.z) * INV_PI",
                            "INV_TWO_PI") == Names{"diffuse-distribution"});
}

TEST_CASE("directions that are turned by a hundred thousandth are not those of their random numbers")
{
    CHECK(failures_with_bug(bsdf_checks(), "diffuse-inversion", "bsdf/diffuse.h", "uniform_float(random.x),",
                            "uniform_float(random.x) + 1e-5,") == Names{"diffuse-inversion"});
}

TEST_CASE("a BSDF that favours one direction is not reciprocal")
{
    CHECK(failures_with_bug(bsdf_checks(), "diffuse-reciprocity", "bsdf/diffuse.h", "scale3(p.albedo, (Float)(INV_PI))",
                            "scale3(p.albedo, abs_of(wi.z))") == Names{"diffuse-reciprocity"});
}

TEST_CASE("a mirror that makes energy is found")
{
    CHECK(failures_with_bug(bsdf_checks(), "mirror-delta", "bsdf/mirror.h", "sample.weight = p.reflectance;",
                            "sample.weight = scale3(p.reflectance, (Float)(1.01));") == Names{"mirror-delta"});
}

TEST_CASE("Fresnel's equations that cancel near the critical angle are found")
{
    CHECK(failures_with_bug(bsdf_checks(), "fresnel-critical", "bsdf/fresnel.h",
                            "second + (second_error + first_error + (eta2_error + c2_error))",
                            "second") == Names{"fresnel-critical-angle", "fresnel-critical-angle-error"});
}
