// Every BSDF of BSDF_LIST under the suite of tests/support/device_bsdf_suite.h, and the choice among them by lane.
#include "scene/material_parser.h"
#include "support/device_bsdf_suite.h"

#include <catch2/catch.hpp>
#include <random>

namespace etendue
{
namespace
{
using Check = void (*)(const Device&, const BsdfCase&);

void for_each_case(bool delta, Check check)
{
    for (const Device& device : test_devices())
        for (int type = 0; type < BSDF_COUNT; ++type) {
            if (bsdf_is_delta(static_cast<BsdfType>(type)) != delta) continue;
            for (const BsdfCase& bsdf : bsdf_cases(static_cast<BsdfType>(type))) check(device, bsdf);
        }
}
} // namespace

TEST_CASE("a sample of a BSDF weighs f times cosine over density, and its density is pdf()")
{
    for_each_case(false, check_weights);
}

TEST_CASE("the density of a BSDF is the Jacobian of its sampling")
{
    for_each_case(false, check_jacobian);
}

TEST_CASE("a BSDF is reciprocal")
{
    for_each_case(false, check_reciprocity);
}

TEST_CASE("the density of a BSDF integrates to the share of samples that have a direction")
{
    for_each_case(false, check_pdf_integral);
}

TEST_CASE("samples of a BSDF are distributed as its density says")
{
    for_each_case(false, check_distribution);
}

TEST_CASE("a BSDF reflects by sampling what it reflects by quadrature, and no more than it receives")
{
    for_each_case(false, check_albedo);
}

TEST_CASE("a BSDF is finite, not negative and without light along the surface")
{
    for_each_case(false, check_edges);
    for_each_case(true, check_edges);
}

TEST_CASE("a delta lobe is sampled only, keeps its energy and can be followed back")
{
    for_each_case(true, check_delta);
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
