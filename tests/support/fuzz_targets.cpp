// Parsing, and the rules for what comes of it.
#include "support/fuzz_targets.h"

#include "geometry/geometry.h"
#include "geometry/mesh_io.h"
#include "geometry/text_scanner.h"
#include "scene/scene_loader.h"
#include "util/json.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace etendue
{
namespace
{
// In a folder with meshes, so that scenes of the course find theirs.
const char* const SCENE_NAME = ETENDUE_SOURCE_DIR "/scenes/course-box/fuzz.json";

void require(bool holds, const std::string& rule)
{
    if (!holds) throw FuzzFinding(rule);
}

// Where a message goes on after the name of the file or the option; npos where it names neither.
std::size_t end_of_place(const std::string& text, const std::string& file)
{
    for (const std::string option : {"command line: ", "-D "})
        if (text.starts_with(option)) return option.size();
    const std::size_t at = text.find(file);
    return at == text.npos ? at : at + file.size();
}

// Whether action() succeeds; if not, its message must say where.
template<class Action>
bool succeeds(const std::string& file, Action action)
{
    try {
        action();
        return true;
    } catch (const Error& error) {
        const std::string text = error.what();
        const std::size_t place = end_of_place(text, file);
        require(place != text.npos, "an error names its file: " + text);
        require(std::count(text.begin() + static_cast<std::ptrdiff_t>(place), text.end(), ' ') >= 2,
                "an error says more than a place: " + text);
        return false;
    }
}

bool is_finite(const real4& value)
{
    return std::isfinite(value.s[0]) && std::isfinite(value.s[1]) && std::isfinite(value.s[2]) &&
           std::isfinite(value.s[3]);
}

void check_geometry(const Geometry& geometry)
{
    const std::size_t primitives = geometry.primitives.size();
    require(primitives == geometry.surfaces.size(), "every primitive has a surface");
    require(primitives == geometry.triangle_count + geometry.sphere_count + geometry.disk_count,
            "every primitive has a kind");
    for (const Primitive& p : geometry.primitives)
        require(is_finite(p.a) && is_finite(p.b) && is_finite(p.c), "primitives are finite");
    for (const real4& normal : geometry.normals) require(is_finite(normal), "normals are finite");
    for (const real parameter : geometry.parameters) require(std::isfinite(parameter), "parameters are finite");
    for (const PrimitiveSurface& surface : geometry.surfaces) {
        require(surface.material < geometry.materials.size(), "materials of surfaces exist");
        require(surface.light == NO_INDEX || surface.light < geometry.lights.size(), "lights of surfaces exist");
        require(surface.normal == NO_INDEX || std::size_t{surface.normal} + 2 < geometry.normals.size(),
                "normals of surfaces exist");
    }
    for (const Light& light : geometry.lights) {
        require(is_finite(light.radiance), "lights are finite");
        require(light.radiance.s[3] > 0, "every light can be chosen");
    }
    for (const AliasBucket& bucket : geometry.light_table)
        require(bucket.alias < geometry.lights.size(), "the table of lights chooses lights that exist");
    const Camera& camera = geometry.camera;
    require(is_finite(camera.position) && is_finite(camera.forward) && is_finite(camera.right) && is_finite(camera.up),
            "the camera is finite");
    require(is_finite(geometry.bounding_sphere), "the sphere around the scene is finite");
}

// Flatten strictly and leniently. What passes strictly passes leniently with nothing dropped.
void flatten(const Scene& scene)
{
    const bool strict = succeeds(scene.file, [&] { check_geometry(make_geometry(scene)); });
    const bool lenient = succeeds(scene.file, [&] {
        const Geometry geometry = make_geometry(scene, {.lenient = true});
        check_geometry(geometry);
        require(!strict || geometry.statistics.dropped_triangles == 0, "nothing of a sound scene is dropped");
    });
    require(lenient || !strict, "what passes strictly passes leniently");
}

// What is canonical is a scene, and the same one.
void check_canonical(const std::string& text, const std::vector<std::string>& overrides, const Scene& scene)
{
    const std::string canonical = json::Document(text, SCENE_NAME, overrides).canonical();
    std::string sha256;
    try {
        sha256 = parse_scene(canonical, SCENE_NAME).scene.sha256;
    } catch (const Error& error) {
        throw FuzzFinding(std::string("the canonical form of a scene is a scene: ") + error.what());
    }
    require(sha256 == scene.sha256, "the canonical form has the scene's sha256");
}

void check_mesh(const Mesh& mesh, bool lenient)
{
    require(!mesh.indices.empty(), "a mesh has triangles");
    for (const Vec3& p : mesh.positions)
        require(lenient || (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)), "positions are finite");
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            require(mesh.indices[i][k] < mesh.positions.size(), "vertices of triangles exist");
            const std::uint32_t normal = mesh.normals_of(i)[k];
            require(normal == NO_INDEX || normal < mesh.normals.size(), "normals of triangles exist");
        }
}

Scene scene_of(const Mesh& mesh, const std::string& file)
{
    Scene scene;
    scene.file = scene.camera.location.file = file;
    scene.materials.push_back({"grey", BSDF_DIFFUSE, {0.5, 0.5, 0.5}, {}});
    ShapeDescription& shape = scene.shapes.emplace_back();
    shape.geometry = InlineTriangles{mesh.positions, {}, mesh.indices};
    shape.emission = Emission{Vec3(1.0), false};
    shape.location.file = file;
    return scene;
}

// Each word that is a number means what the C library reads.
void check_numbers(std::string_view input)
{
    TextScanner scanner(input);
    while (scanner.next_line())
        for (std::string_view word = scanner.next_word(); !word.empty(); word = scanner.next_word()) {
            const auto value = parse_real(word);
            if (!value) continue;
            const std::string text(word);
            char* end = nullptr;
            const double expected = std::strtod(text.c_str(), &end);
            require(end == text.c_str() + text.size(), "a number is one for the C library, too: " + text);
            require(*value == expected || (std::isnan(*value) && std::isnan(expected)), "numbers are exact: " + text);
        }
}

void fuzz_mesh(std::string_view input, const std::string& file)
{
    for (const bool lenient : {false, true}) {
        Mesh mesh;
        if (!succeeds(file, [&] { mesh = parse_mesh(input, file, lenient); })) continue;
        check_mesh(mesh, lenient);
        flatten(scene_of(mesh, file));
        return;
    }
}
} // namespace

void fuzz_scene(std::string_view input)
{
    std::vector<std::string> overrides;
    for (const std::string_view mark = "-D "; input.starts_with(mark) && overrides.size() < 8;) {
        const std::size_t end = std::min(input.find('\n'), input.size());
        overrides.emplace_back(input.substr(mark.size(), end - mark.size()));
        input.remove_prefix(std::min(end + 1, input.size()));
    }
    const std::string text(input);
    Scene scene;
    if (!succeeds(SCENE_NAME, [&] { scene = parse_scene(text, SCENE_NAME, overrides).scene; })) return;
    check_canonical(text, overrides, scene);
    for (ShapeDescription& shape : scene.shapes)
        if (std::holds_alternative<MeshFile>(shape.geometry)) shape.geometry = BoxShape{};
    flatten(scene);
}

void fuzz_obj(std::string_view input)
{
    check_numbers(input);
    fuzz_mesh(input, "fuzz.obj");
}

void fuzz_ply(std::string_view input)
{
    fuzz_mesh(input, "fuzz.ply");
}
} // namespace etendue
