#include "scene/scene_check.h"

using namespace etendue;

namespace
{
Scene lit_scene()
{
    Scene scene;
    scene.file = "a.json";
    scene.materials.resize(1);
    scene.shapes.resize(1);
    scene.shapes[0].geometry = SphereShape{};
    scene.shapes[0].emission = Emission{Vec3(1.0), false};
    return scene;
}
} // namespace

TEST_CASE("a lit scene gives no warning", "[host]")
{
    CHECK(check_scene(lit_scene()).empty());
}

TEST_CASE("a scene without light gives a warning", "[host]")
{
    Scene scene = lit_scene();
    scene.shapes[0].emission->radiance = Vec3(0.0);
    CHECK(check_scene(scene) ==
          std::vector<std::string>{"a.json: nothing in the scene emits light, so the picture will be black."});
    scene.shapes[0].emission.reset();
    CHECK(check_scene(scene).size() == 1);
    scene.environment = EnvironmentDescription{Vec3(0, 0, 1), {}};
    CHECK(check_scene(scene).empty());
    scene.environment.reset();
    scene.integrator.type = IntegratorType::normals;
    CHECK(check_scene(scene).empty());
}

TEST_CASE("an environment alone is a scene, nothing at all is not", "[host]")
{
    Scene scene = lit_scene();
    scene.shapes.clear();
    CHECK_THROWS_WITH(check_scene(scene), "a.json: the scene is empty: it has no shapes, no lights and no environment");
    scene.environment = EnvironmentDescription{Vec3(1.0), {}};
    CHECK(check_scene(scene).empty());
}

TEST_CASE("unlimited depth needs a roulette that ends paths", "[host]")
{
    Scene scene = lit_scene();
    scene.integrator.max_depth.reset();
    CHECK_NOTHROW(check_scene(scene));
    scene.integrator.roulette = RouletteType::off;
    CHECK_THROWS_AS(check_scene(scene), SceneError);
    scene.integrator.roulette = RouletteType::constant;
    CHECK_NOTHROW(check_scene(scene));
    scene.integrator.roulette_probability = 1.0;
    CHECK_THROWS_AS(check_scene(scene), SceneError);
    scene.integrator.max_depth = 5;
    CHECK_NOTHROW(check_scene(scene));
}

TEST_CASE("a camera needs a direction and an up across it", "[host]")
{
    Scene scene = lit_scene();
    scene.camera.up = Vec3(0.0);
    CHECK_THROWS_AS(check_scene(scene), SceneError);
    scene.camera.up = scene.camera.look_at - scene.camera.position;
    CHECK_THROWS_AS(check_scene(scene), SceneError);
    scene.camera.up = Vec3(0, 1, 0);
    scene.camera.look_at = scene.camera.position;
    CHECK_THROWS_AS(check_scene(scene), SceneError);
}
