// Features as build options.
#include "compute/specialization.h"

#include <catch2/catch.hpp>

#include <set>

using namespace etendue;
using Catch::Contains;

TEST_CASE("every feature is a macro of 0 or 1, always defined")
{
    Specialization s;
    s.lanes = 8;
    s.stack_size = 64;
    s.set(Feature::MIRROR);
    const std::string options = s.build_options();
    for (const FeatureDescription& feature : feature_descriptions())
        CHECK_THAT(options, Contains("-D" + std::string(feature.macro) +
                                     (feature.macro == std::string("HAS_MIRROR") ? "=1 " : "=0 ")));
    CHECK_THAT(options, Catch::EndsWith("-DLANES=8 -DSTACK_SIZE=64"));
    s.set(Feature::MIRROR, false);
    CHECK(s == Specialization{0, 8, 64});
}

TEST_CASE("the general kernel has every feature")
{
    const Specialization s = Specialization::everything(4, 128);
    for (std::size_t i = 0; i < feature_descriptions().size(); ++i) CHECK(s.has(static_cast<Feature>(i)));
    CHECK_THAT(s.build_options(), !Contains("=0") && Contains("-DLANES=4 -DSTACK_SIZE=128"));
}

TEST_CASE("features are described by distinct macros in the order of their numbers")
{
    const auto& descriptions = feature_descriptions();
    REQUIRE(descriptions.size() == static_cast<std::size_t>(Feature::COUNT));
    std::set<std::string> macros;
    for (const FeatureDescription& feature : descriptions) macros.insert(feature.macro);
    CHECK(macros.size() == descriptions.size());
    CHECK(descriptions[static_cast<std::size_t>(Feature::LBVH)].name == std::string("lbvh"));
    CHECK(descriptions[static_cast<std::size_t>(Feature::AOV)].macro == std::string("HAS_AOV"));
}
