// Reading shapes, and lights as shapes that emit.
#include "scene/shape_parser.h"

#include "scene/fields.h"
#include "scene/material_parser.h"
#include "scene/scene_tables.h"
#include "scene/transform_parser.h"
#include "util/suggestion.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace fs = std::filesystem;

namespace etendue
{
namespace
{
const char* const BLACK_NAME = "(black)";

using Geometry = decltype(ShapeDescription::geometry);
using MaterialIndex = std::map<std::string, std::uint32_t>;

MeshFile parse_mesh(const Fields& fields, const std::string& folder)
{
    const std::string file = fields.string("file");
    const fs::path path = fs::path(folder) / file;
    std::error_code code;
    if (!fs::exists(path, code)) fields.at("file").fail("there is no file " + path.string());
    if (fs::is_directory(path, code)) fields.at("file").fail(path.string() + " is a directory, not a file");
    return {file};
}

InlineTriangles parse_triangles(const Fields& fields)
{
    InlineTriangles triangles{fields.vectors3("positions"), fields.vectors3("normals"), fields.indices3("indices")};
    const std::size_t count = triangles.positions.size();
    if (triangles.indices.empty()) fields.at("indices").fail("there must be at least one triangle");
    if (fields.has("normals") && triangles.normals.size() != count)
        fields.at("normals").fail(fmt::format("there must be one normal for each of the {} positions, there are {}",
                                              count, triangles.normals.size()));
    for (std::size_t i = 0; i < triangles.indices.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (triangles.indices[i][k] >= count)
                fields.at("indices")[i][static_cast<std::size_t>(k)].fail(fmt::format(
                    "must be less than the number of positions, {}, is {}", count, triangles.indices[i][k]));
    return triangles;
}

Geometry parse_geometry(const Fields& fields, const std::string& type, const std::string& folder)
{
    if (type == "mesh") return parse_mesh(fields, folder);
    if (type == "triangles") return parse_triangles(fields);
    if (type == "rectangle") return RectangleShape{fields.vector2("size")};
    if (type == "box") return BoxShape{fields.vector3("size")};
    if (type == "disk") return DiskShape{fields.number("radius")};
    return SphereShape{fields.number("radius")};
}

std::uint32_t find_material(const json::Value& value, const MaterialIndex& materials)
{
    const auto found = materials.find(value.as_string());
    if (found != materials.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, index] : materials) names.push_back(name);
    value.fail(unknown_name("material", value.as_string(), names));
}

Emission parse_emission(const Fields& fields)
{
    return {fields.colour("radiance"), fields.boolean("two_sided")};
}

// What shapes and lights have in common.
ShapeDescription parse_shape(const Fields& fields, const Table& table, const std::string& folder)
{
    const std::string type = table.variants[fields.variant()].name;
    ShapeDescription shape;
    shape.location = fields.object().location();
    shape.name = fields.string("name");
    shape.geometry = parse_geometry(fields, type, folder);
    shape.flip_normals = fields.boolean("flip_normals");
    shape.transform = parse_transform(fields.objects("transform"));
    if ((type == "sphere" || type == "disk") && !is_similarity(shape.transform))
        fields.at("transform")
            .fail(fmt::format("a {} takes only rotation, translation and a uniform scale; this transform "
                              "bends it into an ellipse",
                              type));
    return shape;
}
} // namespace

std::uint32_t black_material(Scene& scene)
{
    if (scene.materials.empty() || scene.materials.back().name != BLACK_NAME) {
        MaterialDescription black = default_material(BSDF_DIFFUSE);
        black.name = BLACK_NAME;
        black.parameters.assign(black.parameters.size(), 0.0);
        scene.materials.push_back(std::move(black));
    }
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void parse_shapes(const std::vector<json::Value>& shapes, const std::vector<json::Value>& lights, Scene& scene)
{
    MaterialIndex materials;
    for (const MaterialDescription& material : scene.materials)
        materials.emplace(material.name, static_cast<std::uint32_t>(materials.size()));

    for (const json::Value& value : shapes) {
        const Fields fields(value, shape_table());
        ShapeDescription shape = parse_shape(fields, shape_table(), scene.folder);
        fields.string("material");
        shape.material = find_material(fields.at("material"), materials);
        if (fields.has("emission")) shape.emission = parse_emission(Fields(fields.at("emission"), emission_table()));
        scene.shapes.push_back(std::move(shape));
    }
    for (const json::Value& value : lights) {
        const Fields fields(value, light_table());
        ShapeDescription shape = parse_shape(fields, light_table(), scene.folder);
        fields.string("material");
        shape.material =
            fields.has("material") ? find_material(fields.at("material"), materials) : black_material(scene);
        shape.emission = parse_emission(fields);
        scene.shapes.push_back(std::move(shape));
    }
}
} // namespace etendue
