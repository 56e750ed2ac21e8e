// Every BSDF of BSDF_LIST under the quick ones of the checks of src/check/bsdf_checks.h, and the choice among them by
// lane.
#include "check/bsdf_checks.h"
#include "check/bsdf_suite.h"
#include "scene/material_parser.h"
#include "support/device_checks.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <random>

namespace etendue
{
TEST_CASE("a sample of a BSDF weighs f times cosine over density, and its density is pdf()")
{
    require_passed(bsdf_checks(), "-weight");
}

TEST_CASE("the density of a BSDF is the Jacobian of its sampling")
{
    require_passed(bsdf_checks(), "-jacobian");
}

TEST_CASE("a BSDF is reciprocal")
{
    require_passed(bsdf_checks(), "-reciprocity");
}

TEST_CASE("the density of a BSDF integrates to 1, and it reflects by sampling what it reflects by quadrature")
{
    require_passed(bsdf_checks(), "-integral");
}

TEST_CASE("the inverse of a BSDF's sampling finds the random numbers")
{
    require_passed(bsdf_checks(), "-inversion");
}

TEST_CASE("a BSDF is finite, not negative and without light along the surface")
{
    require_passed(bsdf_checks(), "-edges");
}

TEST_CASE("a delta lobe is sampled only, keeps its energy and can be followed back")
{
    require_passed(bsdf_checks(), "-delta");
}

TEST_CASE("each lane gets the BSDF of its own material, the same bits in any company")
{
    std::vector<BsdfCase> cases;
    for (int type = 0; type < BSDF_COUNT; ++type)
        for (const BsdfCase& bsdf : bsdf_cases(static_cast<BsdfType>(type))) cases.push_back(bsdf);
    std::mt19937 random(23);
    std::uniform_real_distribution<float> u(-1, 1);
    std::vector<uint> which;
    std::vector<Direction> wo, wi;
    std::vector<RandomWords> words;
    const auto unit = [&] {
        const float x = u(random), y = u(random), z = u(random), length = std::sqrt(x * x + y * y + z * z);
        return Direction{x / length, y / length, z / length};
    };
    for (int i = 0; i < 4096; ++i) {
        which.push_back(static_cast<uint>(random() % cases.size()));
        wo.push_back(unit());
        wi.push_back(unit());
        words.push_back({static_cast<uint>(random()), static_cast<uint>(random()), static_cast<uint>(random()), 0});
    }
    for (const Device& device : test_devices()) {
        const auto scalar = sample_and_evaluate(device, cases, which, wo, wi, words, 1);
        for (const std::uint32_t lanes : LANE_COUNTS) {
            CAPTURE(lanes);
            const bool same = sample_and_evaluate(device, cases, which, wo, wi, words, lanes) == scalar;
            CHECK(same);
        }
        // Alone: every lane has the one material.
        for (uint k = 0; k < cases.size(); ++k) {
            CAPTURE(cases[k].name);
            const auto alone =
                sample_and_evaluate(device, cases, std::vector<uint>(which.size(), k), wo, wi, words, 16);
            std::size_t different = 0;
            for (std::size_t i = 0; i < which.size(); ++i)
                for (std::size_t output = 0; output < scalar.size() && which[i] == k; ++output)
                    different += scalar[output][i] != alone[output][i];
            CHECK(different == 0);
        }
    }
}
} // namespace etendue
