// Materials: the parameters of every BSDF in one table, and reading materials by it.
#pragma once

#include "scene/scene.h"
#include "scene/table.h"
#include "util/json.h"

#include <string>
#include <vector>

namespace etendue
{
struct BsdfParameter {
    BsdfType bsdf;
    Property property; // Kind::number (one real) or Kind::colour (three)
};

// The rows of the table. Those of one BSDF stand in the order of its reals in MaterialDescription::parameters.
const std::vector<BsdfParameter>& bsdf_parameters();

// "diffuse" for BSDF_DIFFUSE.
std::string bsdf_name(BsdfType bsdf);

// Number of reals in the parameters of a material.
std::size_t bsdf_parameter_count(BsdfType bsdf);

// Index of the first real of a parameter. Throws std::logic_error when the BSDF has none of that name.
std::size_t bsdf_parameter_offset(BsdfType bsdf, const std::string& parameter);

// Scatters only into single directions, so that light sampling cannot reach it.
bool bsdf_is_delta(BsdfType bsdf);

// Of the element of materials[].
const Table& material_table();

// The default parameters of a BSDF, nameless.
MaterialDescription default_material(BsdfType bsdf);

// Read materials[]. Throws SceneError, also where two have one name.
std::vector<MaterialDescription> parse_materials(const std::vector<json::Value>& list);
} // namespace etendue
