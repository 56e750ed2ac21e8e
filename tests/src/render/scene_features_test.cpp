// Each feature is compiled in exactly when a scene needs it.
#include "render/render_settings.h"
#include "render/scene_features.h"
#include "scene/scene_loader.h"
#include "util/error.h"

#include <catch2/catch.hpp>

#include <set>

using namespace etendue;
using Catch::Contains;

namespace
{
// Grey and dark, and as few features as can be.
const char* const SCENE = R"({
    "film": {"size": [4, 4]},
    "integrator": {"type": "bsdf", "max_depth": 3, "roulette": "off"},
    "accelerator": "none",
    "sampler": "independent",
    "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5},
                  {"name": "mirror", "type": "mirror"}, {"name": "glass", "type": "dielectric"}],
    "shapes": [{"type": "rectangle", "size": [2, 2], "material": "grey"}]
})";

Specialization specialization_of(const std::vector<std::string>& overrides, bool has_aov = false)
{
    const Scene scene = parse_scene(SCENE, "features.json", overrides).scene;
    const Geometry geometry = make_geometry(scene);
    const auto settings = make_render_settings(scene, geometry, choose_accelerator(scene.accelerator, 1, 1));
    return scene_features(scene, geometry, settings, has_aov, 4, 40);
}

std::set<std::string> names_of(const Specialization& s)
{
    std::set<std::string> names;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Feature::COUNT); ++i)
        if (s.has(static_cast<Feature>(i))) names.insert(feature_descriptions()[i].name);
    return names;
}

using Names = std::set<std::string>;
} // namespace

TEST_CASE("a plain scene has the features of its one surface and its camera")
{
    CHECK(names_of(specialization_of({})) == Names{"diffuse", "pinhole", "independent", "none"});
    CHECK(specialization_of({}).lanes == 4);
    CHECK(specialization_of({}).stack_size == 64);
}

TEST_CASE("every change of a scene brings its own features and no others")
{
    const auto with = [](std::vector<std::string> overrides) { return names_of(specialization_of(overrides)); };
    const std::string moved = R"("transform":{"translate":[0,0,2]}})";
    CHECK(with({"shapes.0.material=mirror"}) == Names{"mirror", "pinhole", "independent", "none"});
    CHECK(with({R"(shapes=[{"type":"sphere","radius":1,"material":"glass"}])"}) ==
          Names{"dielectric", "sphere", "pinhole", "independent", "none"});
    CHECK(with({R"(shapes=[{"type":"disk","radius":1,"material":"grey"}])"}) ==
          Names{"diffuse", "disk", "pinhole", "independent", "none"});
    CHECK(with({"accelerator=lbvh"}) == Names{"diffuse", "pinhole", "independent", "lbvh"});
    CHECK(with({"integrator.type=hemisphere"}) ==
          Names{"diffuse", "pinhole", "independent", "none", "uniform_hemisphere"});
    CHECK(with({"integrator.roulette=throughput"}) == Names{"diffuse", "pinhole", "independent", "none", "roulette"});
    CHECK(with({R"(integrator.roulette={"type":"constant","probability":0.5})"}) ==
          Names{"diffuse", "pinhole", "independent", "none", "roulette"});
    CHECK(with({"sampler=stratified"}) == Names{"diffuse", "pinhole", "stratified", "none"});
    CHECK(with({"sampler=sobol"}) == Names{"diffuse", "pinhole", "sobol", "none"});
    CHECK(with({R"(sampler={"type":"sobol","replicates":1})"}) == with({"sampler=sobol"}));
    CHECK(with({"film.filter=tent"}) == Names{"diffuse", "pinhole", "independent", "none", "filter"});
    CHECK(with({R"(environment={"radiance":1})"}) ==
          Names{"diffuse", "pinhole", "independent", "none", "environment", "emission_sampling"});
    CHECK(with({R"(shapes=[{"type":"triangles","positions":[[0,0,0],[1,0,0],[0,1,0]],"indices":[[0,1,2]],
                "normals":[[0.6,0,0.8],[0,0,1],[0,0,1]],"material":"grey"}])"}) ==
          Names{"diffuse", "pinhole", "independent", "none", "vertex_normals"});
    // A light brings its shape; its surface is black but has a material too.
    const std::string light = R"(lights=[{"type":"rectangle","size":[1,1],"radiance":1,)" + moved + "]";
    CHECK(with({light}) == Names{"diffuse", "pinhole", "independent", "none", "area", "emission_sampling"});
    CHECK(with({light, "integrator.type=path"}) ==
          Names{"diffuse", "pinhole", "independent", "none", "area", "emission_sampling", "light_sampling"});
    CHECK(with({light, "integrator.type=light"}) ==
          Names{"diffuse", "pinhole", "independent", "none", "area", "light_sampling"});
    // Without a light there is nothing to sample.
    CHECK(with({"integrator.type=path"}) == Names{"diffuse", "pinhole", "independent", "none"});
    CHECK(names_of(specialization_of({}, true)) == Names{"diffuse", "pinhole", "independent", "none", "aov"});
}

TEST_CASE("numbers that a user may turn change no feature")
{
    CHECK(specialization_of({}) ==
          specialization_of({"film.size=[9,3]", R"(sampler={"type":"independent","spp":3,"seed":5})",
                             "integrator.max_depth=9", "camera.vertical_fov=50", "materials.0.albedo=0.1",
                             "integrator.roulette=off"}));
}

TEST_CASE("the film's kernels differ by the AOVs alone")
{
    CHECK(names_of(film_features(false)).empty());
    CHECK(names_of(film_features(true)) == Names{"aov"});
    CHECK(film_features(true).lanes == 1);
}

TEST_CASE("the stack is the smallest class that holds the tree")
{
    CHECK(stack_class(0) == 32);
    CHECK(stack_class(32) == 32);
    CHECK(stack_class(33) == 64);
    CHECK(stack_class(64) == 64);
    CHECK(stack_class(65) == 128);
    CHECK(stack_class(128) == 128);
    CHECK_THROWS_AS(stack_class(129), DeviceError);
    CHECK_THROWS_WITH(stack_class(129), Contains("129") && Contains("128"));
}
