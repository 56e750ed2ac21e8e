// Every object of the native scene format: keys, kinds, ranges, defaults and what they mean.
#include "scene/scene_tables.h"

#include "math/shared.h"
#include "scene/expectation_parser.h"
#include "scene/material_parser.h"

namespace etendue
{
namespace
{
const Range COORDINATE{-MAX_COORDINATE, MAX_COORDINATE};
const Range LENGTH{0, MAX_COORDINATE, true};
const Range RADIANCE{0, MAX_RADIANCE};
const Range INDEX{0, NO_INDEX - 1.0};
const Range SEED{0};

std::vector<Variant> accelerator_variants()
{
    std::vector<Variant> variants{{"auto", "none for a few dozen primitives, else lbvh", {}}};
#define ACCELERATOR_VARIANT(NAME, name, text) variants.push_back({#name, text, {}});
    ACCELERATOR_LIST(ACCELERATOR_VARIANT)
#undef ACCELERATOR_VARIANT
    return variants;
}

std::vector<Variant> sampler_variants()
{
    std::vector<Variant> variants;
#define SAMPLER_VARIANT(NAME, name, text) variants.push_back({#name, text, {}});
    SAMPLER_LIST(SAMPLER_VARIANT)
#undef SAMPLER_VARIANT
    variants[SAMPLER_SOBOL].properties = {
        {"replicates",
         Kind::integer,
         {1, 2},
         "2",
         "sequences scrambled independently, which take turns block by block: two tell the error, one does not"}};
    return variants;
}

std::vector<Variant> camera_variants()
{
    std::vector<Variant> variants;
#define CAMERA_VARIANT(NAME, name, text) variants.push_back({#name, text, {}});
    CAMERA_LIST(CAMERA_VARIANT)
#undef CAMERA_VARIANT
    return variants;
}

// The geometries that shapes and lights share.
std::vector<Variant> geometry_variants()
{
    return {
        {"mesh",
         "triangles of an OBJ or PLY file",
         {{.name = "file", .kind = Kind::string, .standard = REQUIRED, .text = "relative to the scene's folder"}}},
        {"triangles",
         "triangles written in the scene",
         {{"positions", Kind::vectors3, COORDINATE, REQUIRED, "the vertices"},
          {"indices", Kind::indices3, INDEX, REQUIRED,
           "three vertices for each triangle, counted from 0, anticlockwise seen "
           "from the side of the normal"},
          {"normals", Kind::vectors3, COORDINATE, OPTIONAL, "shading normals, one for each vertex"}}},
        {"rectangle",
         "in the plane z = 0, centred, normal +z",
         {{"size", Kind::vector2, LENGTH, "[1, 1]", "edges along x and y"}}},
        {"box", "centred, normals outward", {{"size", Kind::vector3, LENGTH, "[1, 1, 1]", "edges along x, y and z"}}},
        {"disk", "in the plane z = 0, centred, normal +z", {{"radius", Kind::number, LENGTH, "1", "the radius"}}},
        {"sphere", "centred, normals outward", {{"radius", Kind::number, LENGTH, "1", "the radius"}}},
    };
}

Property transform_property()
{
    return {.name = "transform",
            .kind = Kind::object_or_list,
            .text = "from the shape's space to the world; of a list the first is applied first; spheres and disks take "
                    "only rotation, translation and a uniform scale",
            .table = transform_table};
}

Property flip_property()
{
    return {"flip_normals", Kind::boolean, {}, "false", "turn the normals, and with them a one-sided light, round"};
}

Property radiance_property()
{
    return {"radiance", Kind::colour, RADIANCE, REQUIRED, "emitted radiance in W/(sr m^2)"};
}

Property two_sided_property()
{
    return {"two_sided", Kind::boolean, {}, "false", "emit from both sides, not only to the side of the normal"};
}
} // namespace

const Table& scene_table()
{
    static const Table table{
        "scene",
        "The whole file. Metres; right-handed: x right, y up, z towards the viewer; the origin is the centre of the "
        "floor.",
        {{.name = "camera", .kind = Kind::object, .text = "from where", .table = camera_table},
         {.name = "film", .kind = Kind::object, .text = "the picture", .table = film_table},
         {.name = "integrator", .kind = Kind::object, .text = "how light is gathered", .table = integrator_table},
         {.name = "sampler", .kind = Kind::object, .text = "random numbers", .table = sampler_table},
         {.name = "accelerator", .kind = Kind::object, .text = "how rays find surfaces", .table = accelerator_table},
         {.name = "materials", .kind = Kind::objects, .text = "what surfaces are made of", .table = material_table},
         {.name = "shapes", .kind = Kind::objects, .text = "what is in the scene", .table = shape_table},
         {.name = "lights", .kind = Kind::objects, .text = "shapes that emit", .table = light_table},
         {.name = "environment", .kind = Kind::object, .text = "light from far away", .table = environment_table},
         {.name = "expect",
          .kind = Kind::object,
          .text = "what the picture must be, for etendue check",
          .table = expectation_table}}};
    return table;
}

const Table& camera_table()
{
    static const Table table{
        "camera",
        "Where the picture is taken from.",
        {{"position", Kind::vector3, COORDINATE, "[0, 1, 6.8]", "the pinhole"},
         {"look_at", Kind::vector3, COORDINATE, "[0, 1, 0]", "a point that appears in the centre of the picture"},
         {"up", Kind::vector3, COORDINATE, "[0, 1, 0]", "a direction that points upwards in the picture"},
         {"vertical_fov",
          Kind::number,
          {0, 180, true, true},
          "19.5",
          "angle in degrees from the lower to the upper edge"},
         {"focal_length",
          Kind::number,
          {0, MAX_COORDINATE, true},
          "1",
          "multiplies the tangent of half the angle: more than 1 sees more"}},
        camera_variants(),
        "pinhole",
        true};
    return table;
}

const Table& film_table()
{
    static const Table table{
        "film",
        "The picture.",
        {{"size", Kind::size2, {1, MAX_FILM_SIZE}, "[600, 600]", "width and height in pixels"},
         {.name = "filter", .kind = Kind::object, .text = "how samples become pixels", .table = filter_table},
         {"tone_map", Kind::name, {}, "\"srgb\"", "for 8-bit files; gamma22 is clamp(c^(1/2.2))", {"srgb", "gamma22"}},
         {"exposure", Kind::number, {-64, 64}, "0", "stops, for 8-bit files"}}};
    return table;
}

const Table& filter_table()
{
    const Range radius{0, 16, true};
    static const Table table{"filter",
                             "The pixel filter, sampled by importance: no pixel depends on its neighbours' samples.",
                             {},
                             {{"box", "constant", {{"radius", Kind::number, radius, "0.5", "in pixels"}}},
                              {"tent", "falls linearly", {{"radius", Kind::number, radius, "1", "in pixels"}}},
                              {"gaussian",
                               "a bell, cut off at the radius",
                               {{"radius", Kind::number, radius, "2", "in pixels"},
                                {"sigma", Kind::number, radius, "0.5", "standard deviation in pixels"}}}},
                             "box",
                             true};
    return table;
}

const Table& integrator_table()
{
    static const Table table{
        "integrator",
        "How light is gathered. All but normals converge to the same picture.",
        {{"max_depth",
          Kind::depth,
          {0, MAX_PATH_VERTICES},
          "12",
          "surface vertices of a path at which light is gathered: 0 is emission only, 1 direct light"},
         {"heuristic",
          Kind::name,
          {},
          "\"power\"",
          "how the integrator path weighs the two ways of finding a light",
          {"power", "balance"}},
         {"sphere_lights",
          Kind::name,
          {},
          "\"cone\"",
          "how points on spheres that emit are chosen from outside: by direction or by area",
          {"cone", "area"}},
         {.name = "roulette", .kind = Kind::object, .text = "Russian roulette", .table = roulette_table}},
        {{"normals", "one ray for each sample, coloured by the normal it meets", {}},
         {"hemisphere", "directions uniform over the hemisphere, no sampling of lights", {}},
         {"bsdf", "directions by the BSDF, no sampling of lights", {}},
         {"light", "points on lights, and directions by the BSDF for indirect light", {}},
         {"path", "points on lights and directions by the BSDF, combined by multiple importance sampling", {}}},
        "path",
        true};
    return table;
}

const Table& roulette_table()
{
    const Property start{
        "start", Kind::integer, {0, MAX_PATH_VERTICES}, "3", "vertices of a path before roulette begins"};
    static const Table table{
        "roulette",
        "How paths end at random without a bias.",
        {},
        {{"off", "paths end at max_depth only", {}},
         {"constant",
          "every path survives with the same probability",
          {{"probability", Kind::number, {0, 1, true}, "0.8", "of survival at each vertex"}, start}},
         {"throughput", "dark paths end sooner", {start}}},
        "throughput",
        true};
    return table;
}

const Table& sampler_table()
{
    static const Table table{"sampler",
                             "Random numbers.",
                             {{"spp", Kind::integer, {1, 1e15}, "64", "samples per pixel"},
                              {"seed", Kind::integer, SEED, "0", "another seed gives other noise"}},
                             sampler_variants(),
                             "sobol",
                             true};
    return table;
}

const Table& accelerator_table()
{
    static const Table table{
        "accelerator",
        "How rays find surfaces. The picture is the same.",
        {{"build", Kind::name, {}, "\"auto\"", "where the tree is built", {"auto", "host", "device"}}},
        accelerator_variants(),
        "auto",
        true};
    return table;
}

const Table& shape_table()
{
    static const Table table{
        "shape",
        "Something to see.",
        {{.name = "name", .kind = Kind::string, .text = "for messages"},
         {.name = "material", .kind = Kind::string, .standard = REQUIRED, .text = "the name of one of the materials"},
         transform_property(),
         {.name = "emission", .kind = Kind::object, .text = "makes the shape a light", .table = emission_table},
         flip_property()},
        geometry_variants()};
    return table;
}

const Table& light_table()
{
    static const Table table{
        "light",
        "A shape that emits; it has the types and keys of a shape.",
        {{.name = "name", .kind = Kind::string, .text = "for messages"},
         radiance_property(),
         two_sided_property(),
         {.name = "material", .kind = Kind::string, .text = "the name of one of the materials; black when left out"},
         transform_property(),
         flip_property()},
        geometry_variants()};
    return table;
}

const Table& emission_table()
{
    static const Table table{"emission", "What makes a shape a light.", {radiance_property(), two_sided_property()}};
    return table;
}

const Table& transform_table()
{
    static const Table table{
        .name = "transform",
        .text = "One step.",
        .properties = {{"translate", Kind::vector3, COORDINATE, OPTIONAL, "move by"},
                       {.name = "rotate", .kind = Kind::object, .text = "turn", .table = rotate_table},
                       {"scale", Kind::scale, COORDINATE, OPTIONAL, "stretch, by one factor or one for each axis"},
                       {.name = "look_at", .kind = Kind::object, .text = "place and aim", .table = look_at_table},
                       {"matrix", Kind::matrix, COORDINATE, OPTIONAL,
                        "applied to column vectors; the last row is 0 0 0 1"}},
        .exactly_one = true};
    return table;
}

const Table& rotate_table()
{
    static const Table table{"rotation",
                             "Anticlockwise when the axis points at the viewer.",
                             {{"axis", Kind::vector3, COORDINATE, REQUIRED, "any length but zero"},
                              {"angle", Kind::number, {-1e6, 1e6}, REQUIRED, "degrees"}}};
    return table;
}

const Table& look_at_table()
{
    static const Table table{
        "look_at",
        "Moves the origin to the position and turns +z towards the target and +y as far up as it goes.",
        {{"position", Kind::vector3, COORDINATE, REQUIRED, "where the origin goes"},
         {"target", Kind::vector3, COORDINATE, REQUIRED, "where +z points"},
         {"up", Kind::vector3, COORDINATE, "[0, 1, 0]", "upwards"}}};
    return table;
}

const Table& environment_table()
{
    static const Table table{"environment",
                             "Light from infinitely far away, the same from everywhere.",
                             {{"radiance", Kind::colour, RADIANCE, REQUIRED, "radiance in W/(sr m^2)"}}};
    return table;
}

std::vector<const Table*> all_tables()
{
    return {&scene_table(),       &camera_table(),      &film_table(),        &filter_table(),   &integrator_table(),
            &roulette_table(),    &sampler_table(),     &accelerator_table(), &material_table(), &shape_table(),
            &light_table(),       &emission_table(),    &transform_table(),   &rotate_table(),   &look_at_table(),
            &environment_table(), &expectation_table(), &fact_table()};
}
} // namespace etendue
