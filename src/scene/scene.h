// A scene as plain data: what a file says, names resolved and defaults filled, nothing converted or built yet.
// World space: metres, right-handed, x right, y up, z towards the viewer; the origin is the centre of the floor.
#pragma once

#include "math/color.h"
#include "math/shared.h"
#include "math/vector.h"
#include "scene/formula_text.h"
#include "util/error.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace etendue
{
struct CameraDescription {
    Vec3 position{0, 1, 6.8};
    Vec3 look_at{0, 1, 0};
    Vec3 up{0, 1, 0};
    double vertical_fov = 19.5; // degrees, of the whole image height
    double focal_length = 1.0;  // multiplies tan(vertical_fov / 2), as in the course
    SourceLocation location;
};

enum class FilterType { box, tent, gaussian };

struct FilmDescription {
    int width = 600;
    int height = 600;
    FilterType filter = FilterType::box;
    double filter_radius = 0.5; // pixels; tent 1, gaussian 2 by default
    double filter_sigma = 0.5;  // pixels; gaussian only
    ToneMap tone_map = ToneMap::srgb;
    double exposure = 0.0; // stops; tone-mapped files only
    SourceLocation location;
};

enum class IntegratorType { normals, hemisphere, bsdf, light, path };
enum class RouletteType { off, constant, throughput };

// How light samples and BSDF samples are weighed; in the order of their names in integrator_table().
enum class MisHeuristic { power, balance };

// How spheres that emit are sampled from outside; in the order of their names there.
enum class SphereLights { cone, area };

struct IntegratorDescription {
    IntegratorType type = IntegratorType::path;
    std::optional<std::uint32_t> max_depth = 12; // surface vertices at which light is gathered; empty: no limit
    RouletteType roulette = RouletteType::throughput;
    double roulette_probability = 0.8; // survival; constant only
    std::uint32_t roulette_start = 3;  // vertices before roulette begins
    MisHeuristic heuristic = MisHeuristic::power;
    SphereLights sphere_lights = SphereLights::cone;
    SourceLocation location;
};

enum class SamplerType { independent, stratified, sobol };

struct SamplerDescription {
    SamplerType type = SamplerType::independent;
    std::uint64_t samples_per_pixel = 64;
    std::uint64_t seed = 0;
    std::uint32_t replicates =
        2; // sobol only: sequences scrambled independently, 1 or 2; their difference is the error
    SourceLocation location;
};

enum class BuildPlace { automatic, host, device };

struct AcceleratorDescription {
    // Empty: lbvh, or none where the scene is so small that testing every primitive is faster.
    std::optional<AcceleratorType> type;
    BuildPlace build = BuildPlace::automatic;
    SourceLocation location;
};

struct MaterialDescription {
    std::string name;
    BsdfType bsdf = BSDF_DIFFUSE;
    std::vector<double> parameters; // in the order of the parameter table of material_parser.h; a colour is three
    SourceLocation location;
};

// What makes a shape emit. Radiance in W/(sr m^2), linear sRGB primaries.
struct Emission {
    Vec3 radiance{0.0};
    bool two_sided = false;
};

struct MeshFile {
    std::string file; // as written in the scene; resolved against the scene's folder
};
struct InlineTriangles {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals; // empty, or one per position
    std::vector<glm::u32vec3> indices;
};
// The square [-1/2, 1/2]^2 of the plane z = 0, normal +z, before the transform; size is its edges.
struct RectangleShape {
    Vec2 size{1.0};
};
// Centred at the origin before the transform; size is its edges. Normals outward.
struct BoxShape {
    Vec3 size{1.0};
};
// In the plane z = 0, normal +z, before the transform. The transform must be a similarity.
struct DiskShape {
    double radius = 1.0;
};
// Centred at the origin before the transform, which must be a similarity. Normals outward.
struct SphereShape {
    double radius = 1.0;
};

struct ShapeDescription {
    std::string name;
    std::variant<MeshFile, InlineTriangles, RectangleShape, BoxShape, DiskShape, SphereShape> geometry;
    Mat4 transform{1.0};
    std::uint32_t material = 0; // index into Scene::materials
    std::optional<Emission> emission;
    bool flip_normals = false;
    SourceLocation location; // of the shape's object
};

struct EnvironmentDescription {
    Vec3 radiance{0.0};
    SourceLocation location;
};

// One thing that a scene says of its own picture; etendue check judges it.
struct ExpectedFact {
    enum class Subject {
        pixels,            // every pixel; of one sample each: every sample
        mean,              // of all pixels
        relative_variance, // of one sample: variance / mean^2
        second_moment,     // of one sample: mean of squares
        rays,              // traced for each sample, shadow rays too
        same,              // as the picture of another scene
        load_error,        // loading fails with a message that contains `text`
        warning            // a warning contains `text`
    } subject = Subject::pixels;
    enum class Rule { exact, round, bound, count, stat } rule = Rule::round;
    std::vector<FormulaText> value;         // one for all channels or three; of pixels, moments and rays
    std::optional<FormulaText> other_value; // pixels: what some pixels are instead
    Vec2 other_share{0, 1};                 // pixels: the share of those, from and to
    std::optional<FormulaText> tolerance;   // roundings, or relative, as the table of the subject says
    std::optional<FormulaText> delta;       // mean, same: the relative bias that must be seen; empty: that of the run
    double share = 1.0;                     // same: of the pixels that must be within the tolerance
    std::string text;                       // load_error, warning
    std::string scene;                      // same: a file beside this one; "": this one ...
    std::vector<std::string> overrides;     // ... with these path=value; load_error too
    bool specialized = false;               // same: rendered by the kernel with this scene's features only
    SourceLocation location;
};

// The "expect" block: a scene that knows what its picture must be.
struct Expectation {
    enum class Group { analytic, stiff } group = Group::stiff;
    bool is_long = false;                                   // only with --long
    std::string because;                                    // the derivation in a line
    std::vector<std::pair<std::string, FormulaText>> where; // names of formulas, sorted
    bool lenient = false;                                   // loaded as by --lenient
    std::vector<ExpectedFact> facts;                        // at least one
    SourceLocation location;
};

struct Scene {
    std::string file;   // as the user named it
    std::string folder; // for the files it names
    std::string sha256; // of the text and its -D overrides (not of meshes)
    bool course_format = false;
    CameraDescription camera;
    FilmDescription film;
    IntegratorDescription integrator;
    SamplerDescription sampler;
    AcceleratorDescription accelerator;
    std::vector<MaterialDescription> materials;
    std::vector<ShapeDescription> shapes; // lights[] of the file are shapes that emit, after the shapes[]
    std::optional<EnvironmentDescription> environment;
    std::optional<Expectation> expectation;
};
} // namespace etendue
