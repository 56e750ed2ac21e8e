// Reading the course's scene format.
#include "scene/importers/course.h"

#include "scene/fields.h"
#include "scene/material_parser.h"
#include "scene/scene_tables.h"
#include "scene/shape_parser.h"
#include "util/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;

namespace etendue
{
namespace
{
const Range COORDINATE{-MAX_COORDINATE, MAX_COORDINATE};
const Range LENGTH{0, MAX_COORDINATE, true};

// The types of materials seen in such files, and the BSDF and the name of the colour that each is here.
struct CourseMaterial {
    std::string type;
    BsdfType bsdf;
    std::string colour;
};
const std::vector<CourseMaterial>& course_materials()
{
    static const std::vector<CourseMaterial> list{{"diffuse", BSDF_DIFFUSE, "albedo"},
                                                  {"specular", BSDF_MIRROR, "reflectance"},
                                                  {"translucent", BSDF_DIELECTRIC, "tint"},
                                                  {"glass", BSDF_DIELECTRIC, "tint"}};
    return list;
}

std::vector<std::string> course_material_types()
{
    std::vector<std::string> types;
    for (const CourseMaterial& material : course_materials()) types.push_back(material.type);
    return types;
}

const Table& camera_section()
{
    static const Table table{"cam_config",
                             "",
                             {{"position", Kind::vector3, COORDINATE, "[0, 1, 6.8]"},
                              {"look_at", Kind::vector3, COORDINATE, "[0, 1, 0]"},
                              {"ref_up", Kind::vector3, COORDINATE, "[0, 1, 0]"},
                              {"vertical_fov", Kind::number, {0, 180, true, true}, "19.5"},
                              {"focal_length", Kind::number, LENGTH, "1"}}};
    return table;
}

const Table& light_section()
{
    static const Table table{"light_config",
                             "",
                             {{"position", Kind::vector3, COORDINATE, "[0, 1.98, 0]"},
                              {"size", Kind::vector2, LENGTH, "[0.5, 0.5]"},
                              {"radiance", Kind::colour, {0, MAX_RADIANCE}, "[17, 12, 5]"}}};
    return table;
}

const Table& material_section()
{
    static const Table table{
        "material",
        "",
        {{.name = "name", .kind = Kind::string, .standard = REQUIRED},
         {.name = "type", .kind = Kind::name, .standard = "\"diffuse\"", .names = course_material_types()},
         {"color", Kind::colour, {0, 1}, "0.5"}}};
    return table;
}

const Table& object_section()
{
    static const Table table{"object",
                             "",
                             {{.name = "obj_file_path", .kind = Kind::string, .standard = REQUIRED},
                              {.name = "material_name", .kind = Kind::string, .standard = REQUIRED},
                              {"translate", Kind::vector3, COORDINATE, "[0, 0, 0]"},
                              {"scale", Kind::number, LENGTH, "1"},
                              {.name = "has_bvh", .kind = Kind::boolean}, // changes speed only
                              {.name = "is_NURBS", .kind = Kind::boolean},
                              {.name = "nurbs", .kind = Kind::boolean}}};
    return table;
}

const Table& whole_file()
{
    static const Table table{"course scene",
                             "",
                             {{"spp", Kind::integer, {1, 1e15}, "256"},
                              {"max_depth", Kind::integer, {0, MAX_PATH_VERTICES}, "12"},
                              {"image_resolution", Kind::size2, {1, MAX_FILM_SIZE}, "[600, 600]"},
                              {.name = "cam_config", .kind = Kind::object, .table = camera_section},
                              {.name = "light_config", .kind = Kind::object, .table = light_section},
                              {.name = "materials", .kind = Kind::objects, .table = material_section},
                              {.name = "objects", .kind = Kind::objects, .table = object_section},
                              {.name = "nurbs", .kind = Kind::objects, .table = object_section}}};
    return table;
}

void refuse_nurbs(const Fields& fields)
{
    for (const char* key : {"is_NURBS", "nurbs"}) {
        if (!fields.has(key)) continue;
        const json::Value value = fields.at(key);
        const bool harmless = value.raw().isNull() || (value.is_boolean() && !value.as_boolean()) ||
                              (value.is_array() && value.size() == 0);
        if (!harmless)
            throw SceneError(fields.object().key_location(key),
                             "NURBS surfaces are not supported; convert them to a triangle mesh");
    }
}

// Where a mesh may be, in the order of trying.
std::vector<fs::path> candidate_paths(const std::string& file, const fs::path& folder)
{
    if (fs::path(file).is_absolute()) return {file};
    std::vector<fs::path> candidates{folder / file, file};
    std::string bare = file;
    while (bare.starts_with("../")) bare.erase(0, 3);
    for (const fs::path& start : {fs::absolute(folder).lexically_normal(), fs::current_path()})
        for (fs::path above = start;; above = above.parent_path()) {
            candidates.push_back(above / bare);
            if (above == above.parent_path()) break;
        }

    // Name each place once.
    std::vector<fs::path> unique, absolute;
    for (const fs::path& candidate : candidates) {
        const fs::path place = fs::absolute(candidate).lexically_normal();
        if (std::find(absolute.begin(), absolute.end(), place) != absolute.end()) continue;
        absolute.push_back(place);
        unique.push_back(candidate);
    }
    return unique;
}

// The path of the mesh such that the scene's folder / path is the file.
std::string find_mesh(const json::Value& value, const fs::path& folder)
{
    const std::vector<fs::path> candidates = candidate_paths(value.as_string(), folder);
    std::string tried;
    for (const fs::path& candidate : candidates) {
        std::error_code code;
        if (fs::exists(candidate, code) && !fs::is_directory(candidate, code))
            return candidate == folder / value.as_string() ? value.as_string()
                                                           : fs::absolute(candidate).lexically_normal().string();
        tried += "\n    " + candidate.string();
    }
    throw SceneError(value.location(), "the mesh file does not exist; tried:" + tried);
}

MaterialDescription parse_material(const Fields& fields, const std::string& file, std::vector<std::string>& warnings)
{
    const CourseMaterial& course = course_materials()[fields.name("type")];
    const Vec3 colour = fields.colour("color");
    MaterialDescription material = default_material(course.bsdf);
    material.name = fields.string("name");
    material.location = fields.object().location();
    const std::size_t offset = bsdf_parameter_offset(course.bsdf, course.colour);
    for (int i = 0; i < 3; ++i) material.parameters[offset + static_cast<std::size_t>(i)] = colour[i];
    if (course.bsdf != BSDF_DIFFUSE && colour == Vec3(0.0))
        warnings.push_back(
            fmt::format("{}: the {} material \"{}\" has the colour [0, 0, 0], taken literally: it is black.", file,
                        course.type, material.name));
    return material;
}

std::uint32_t find_material(const json::Value& value, const Scene& scene)
{
    std::vector<std::string> names;
    for (const MaterialDescription& material : scene.materials) names.push_back(material.name);
    const auto found = std::find(names.begin(), names.end(), value.as_string());
    if (found == names.end()) value.fail(unknown_name("material", value.as_string(), names));
    return static_cast<std::uint32_t>(found - names.begin());
}

ShapeDescription parse_object(const Fields& fields, const Scene& scene)
{
    refuse_nurbs(fields);
    ShapeDescription shape;
    shape.name = fields.string("obj_file_path");
    fields.string("material_name");
    shape.material = find_material(fields.at("material_name"), scene);
    shape.geometry = MeshFile{find_mesh(fields.at("obj_file_path"), scene.folder)};
    const double scale = fields.number("scale");
    shape.transform =
        Mat4(Vec4(scale, 0, 0, 0), Vec4(0, scale, 0, 0), Vec4(0, 0, scale, 0), Vec4(fields.vector3("translate"), 1));
    shape.location = fields.object().location();
    return shape;
}

// A rectangle of the plane y = const that emits downwards: local x to x, local y to z, local normal +z to -y.
ShapeDescription parse_light(const Fields& fields, const SourceLocation& where, Scene& scene)
{
    ShapeDescription light;
    light.name = "light_config";
    light.geometry = RectangleShape{fields.vector2("size")};
    light.transform = Mat4(Vec4(1, 0, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, -1, 0, 0), Vec4(fields.vector3("position"), 1));
    light.material = black_material(scene);
    light.emission = Emission{fields.colour("radiance"), false};
    light.location = where;
    return light;
}
} // namespace

bool is_course_scene(const json::Value& root)
{
    return root.has("cam_config") || root.has("light_config");
}

Scene parse_course_scene(const json::Value& root, const std::string& folder, std::vector<std::string>& warnings)
{
    std::vector<std::string> ignored;
    const UnknownKeys unknown = UnknownKeys::collect(ignored);
    const Fields file(root, whole_file(), unknown);
    refuse_nurbs(file);
    const json::Document empty("{}", "default");
    const auto section = [&](const char* key, const Table& table) {
        return Fields(file.has(key) ? file.at(key) : empty.root(), table, unknown);
    };
    const std::string name = root.location().file;

    Scene scene;
    scene.folder = folder;
    scene.course_format = true;
    const Fields camera = section("cam_config", camera_section());
    scene.camera = {
        camera.vector3("position"),    camera.vector3("look_at"),
        camera.vector3("ref_up"),      camera.number("vertical_fov"),
        camera.number("focal_length"), file.has("cam_config") ? file.at("cam_config").location() : root.location()};
    const glm::u64vec2 size = file.size2("image_resolution");
    scene.film.width = static_cast<int>(size.x);
    scene.film.height = static_cast<int>(size.y);
    scene.film.tone_map = ToneMap::gamma22;
    scene.film.location = scene.integrator.location = scene.sampler.location = root.location();
    scene.integrator.max_depth = static_cast<std::uint32_t>(file.integer("max_depth"));
    scene.sampler.type = SamplerType::sobol; // the default of the native format too
    scene.sampler.samples_per_pixel = file.integer("spp");

    for (const json::Value& value : file.objects("materials"))
        scene.materials.push_back(parse_material(Fields(value, material_section(), unknown), name, warnings));
    for (const json::Value& value : file.objects("objects"))
        scene.shapes.push_back(parse_object(Fields(value, object_section(), unknown), scene));
    const SourceLocation light = file.has("light_config") ? file.at("light_config").location() : root.location();
    scene.shapes.push_back(parse_light(section("light_config", light_section()), light, scene));

    if (!ignored.empty())
        warnings.push_back(fmt::format("{}: these keys are unknown and ignored: {}.", name, list_names(ignored)));
    return scene;
}
} // namespace etendue
