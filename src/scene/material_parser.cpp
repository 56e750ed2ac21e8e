// The parameter table of the BSDFs, and reading materials by it.
#include "scene/material_parser.h"

#include "scene/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace etendue
{
namespace
{
struct BsdfDescription {
    std::string name;
    std::string text;
};

const std::vector<BsdfDescription>& bsdf_descriptions()
{
#define BSDF_DESCRIPTION(NAME, name, text) {#name, text},
    static const std::vector<BsdfDescription> list{BSDF_LIST(BSDF_DESCRIPTION)};
#undef BSDF_DESCRIPTION
    return list;
}

const std::vector<BsdfType> DELTA_BSDFS{BSDF_MIRROR, BSDF_DIELECTRIC};

std::size_t real_count(const Property& property)
{
    return property.kind == Kind::colour ? 3 : 1;
}
} // namespace

const std::vector<BsdfParameter>& bsdf_parameters()
{
    const Range fraction{0, 1};
    static const std::vector<BsdfParameter> table{
        {BSDF_DIFFUSE, {"albedo", Kind::colour, fraction, "0.5", "fraction of the light that is reflected"}},
        {BSDF_MIRROR, {"reflectance", Kind::colour, fraction, "1", "fraction of the light that is reflected"}},
        {BSDF_DIELECTRIC, {"ior", Kind::number, {0.01, 100}, "1.5", "index of refraction inside over outside"}},
        {BSDF_DIELECTRIC, {"tint", Kind::colour, fraction, "1", "multiplies what is reflected and what passes"}},
    };
    return table;
}

std::string bsdf_name(BsdfType bsdf)
{
    return bsdf_descriptions()[bsdf].name;
}

std::size_t bsdf_parameter_count(BsdfType bsdf)
{
    std::size_t count = 0;
    for (const BsdfParameter& row : bsdf_parameters())
        if (row.bsdf == bsdf) count += real_count(row.property);
    return count;
}

std::size_t bsdf_parameter_offset(BsdfType bsdf, const std::string& parameter)
{
    std::size_t offset = 0;
    for (const BsdfParameter& row : bsdf_parameters()) {
        if (row.bsdf != bsdf) continue;
        if (row.property.name == parameter) return offset;
        offset += real_count(row.property);
    }
    throw std::logic_error("the bsdf " + bsdf_name(bsdf) + " has no parameter " + parameter);
}

bool bsdf_is_delta(BsdfType bsdf)
{
    return std::find(DELTA_BSDFS.begin(), DELTA_BSDFS.end(), bsdf) != DELTA_BSDFS.end();
}

const Table& material_table()
{
    static const Table table = [] {
        Table t{
            .name = "material",
            .text = "What a surface is made of.",
            .properties = {{.name = "name", .kind = Kind::string, .standard = REQUIRED, .text = "what shapes call it"}},
            .type_noun = "bsdf"};
        for (const BsdfDescription& bsdf : bsdf_descriptions()) t.variants.push_back({bsdf.name, bsdf.text, {}});
        for (const BsdfParameter& row : bsdf_parameters()) t.variants[row.bsdf].properties.push_back(row.property);
        return t;
    }();
    return table;
}

MaterialDescription default_material(BsdfType bsdf)
{
    const json::Document document(fmt::format(R"({{"name": "", "type": "{}"}})", bsdf_name(bsdf)), "default material");
    MaterialDescription material = parse_materials({document.root()}).front();
    material.location = {};
    return material;
}

std::vector<MaterialDescription> parse_materials(const std::vector<json::Value>& list)
{
    std::vector<MaterialDescription> materials;
    std::map<std::string, SourceLocation> places;
    for (const json::Value& value : list) {
        const Fields fields(value, material_table());
        MaterialDescription material;
        material.name = fields.string("name");
        material.bsdf = static_cast<BsdfType>(fields.variant());
        for (const BsdfParameter& row : bsdf_parameters()) {
            if (row.bsdf != material.bsdf) continue;
            for (const double x : fields.reals(row.property.name)) material.parameters.push_back(x);
        }
        material.location = value.location();

        const auto [first, is_new] = places.emplace(material.name, material.location);
        if (!is_new)
            fields.at("name").fail(
                fmt::format("there is another material named \"{}\" ({})", material.name, first->second.pointer));
        materials.push_back(std::move(material));
    }
    return materials;
}
} // namespace etendue
