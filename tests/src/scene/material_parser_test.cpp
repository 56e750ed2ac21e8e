#include "scene/material_parser.h"

#include <stdexcept>

using namespace etendue;

namespace
{
std::vector<MaterialDescription> parse(const std::string& text)
{
    const json::Document document(text, "a.json");
    std::vector<json::Value> list;
    for (std::size_t i = 0; i < document.root().size(); ++i) list.push_back(document.root()[i]);
    return parse_materials(list);
}
} // namespace

TEST_CASE("the reals of a material stand in the order of the table", "[host]")
{
    const auto materials = parse(R"([{"name": "a", "type": "diffuse", "albedo": [0.1, 0.2, 0.3]},
        {"name": "b", "type": "mirror", "reflectance": 0.9},
        {"name": "c", "type": "dielectric", "tint": [1, 0.5, 0], "ior": 1.33}])");
    REQUIRE(materials.size() == 3);
    CHECK(materials[0].bsdf == BSDF_DIFFUSE);
    CHECK(materials[0].parameters == std::vector<double>{0.1, 0.2, 0.3});
    CHECK(materials[1].bsdf == BSDF_MIRROR);
    CHECK(materials[1].parameters == std::vector<double>{0.9, 0.9, 0.9});
    CHECK(materials[2].bsdf == BSDF_DIELECTRIC);
    CHECK(materials[2].parameters == std::vector<double>{1.33, 1, 0.5, 0});
    CHECK(materials[2].location.line == 3);
}

TEST_CASE("a material without parameters has the defaults", "[host]")
{
    CHECK(default_material(BSDF_DIFFUSE).parameters == std::vector<double>{0.5, 0.5, 0.5});
    CHECK(default_material(BSDF_MIRROR).parameters == std::vector<double>{1, 1, 1});
    CHECK(default_material(BSDF_DIELECTRIC).parameters == std::vector<double>{1.5, 1, 1, 1});
}

TEST_CASE("count and offsets of parameters agree with the materials that are read", "[host]")
{
    for (int i = 0; i < BSDF_COUNT; ++i) {
        const auto bsdf = static_cast<BsdfType>(i);
        CHECK(default_material(bsdf).parameters.size() == bsdf_parameter_count(bsdf));
        CHECK(bsdf_parameter_count(bsdf) > 0);
    }
    CHECK(bsdf_parameter_offset(BSDF_DIELECTRIC, "ior") == 0);
    CHECK(bsdf_parameter_offset(BSDF_DIELECTRIC, "tint") == 1);
    CHECK_THROWS_AS(bsdf_parameter_offset(BSDF_DIFFUSE, "ior"), std::logic_error);
}

TEST_CASE("mirrors and smooth dielectrics are delta, matte surfaces are not", "[host]")
{
    CHECK_FALSE(bsdf_is_delta(BSDF_DIFFUSE));
    CHECK(bsdf_is_delta(BSDF_MIRROR));
    CHECK(bsdf_is_delta(BSDF_DIELECTRIC));
}

TEST_CASE("the parameter table names every BSDF of the feature list", "[host]")
{
    CHECK(bsdf_name(BSDF_DIELECTRIC) == "dielectric");
    CHECK(material_table().variants.size() == BSDF_COUNT);
}
