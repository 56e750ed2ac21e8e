#include "scene/scene_loader.h"
#include "util/file.h"

#include <filesystem>

using namespace etendue;
namespace fs = std::filesystem;

namespace
{
const std::string COURSE_BOX = ETENDUE_SOURCE_DIR "/scenes/course-box/";

// A scene with one material and, when named, one object.
std::string course_text(const std::string& material, const std::string& object = "")
{
    return R"({"cam_config": {}, "materials": [)" + material + R"(], "objects": [)" + object + "]}";
}

Vec3 apply(const Mat4& m, const Vec3& p)
{
    return Vec3(m * Vec4(p, 1));
}
} // namespace

TEST_CASE("the course's scene is the same problem in both formats", "[host]")
{
    const LoadedScene course = load_scene(COURSE_BOX + "simple.json");
    const Scene native = load_scene(COURSE_BOX + "simple_native.json").scene;
    const Scene& scene = course.scene;
    CHECK(course.warnings.empty());
    CHECK(scene.course_format);
    CHECK(scene.camera.position == native.camera.position);
    CHECK(scene.camera.look_at == native.camera.look_at);
    CHECK(scene.camera.up == native.camera.up);
    CHECK(scene.camera.vertical_fov == native.camera.vertical_fov);
    CHECK(scene.camera.focal_length == native.camera.focal_length);
    CHECK(scene.film.width == native.film.width);
    CHECK(scene.film.height == native.film.height);
    CHECK(scene.film.tone_map == native.film.tone_map);
    CHECK(scene.integrator.type == native.integrator.type);
    CHECK(scene.integrator.max_depth == native.integrator.max_depth);
    CHECK(scene.integrator.roulette == native.integrator.roulette);
    CHECK(scene.sampler.type == native.sampler.type);
    CHECK(scene.sampler.replicates == native.sampler.replicates);
    CHECK(scene.sampler.samples_per_pixel == native.sampler.samples_per_pixel);
    REQUIRE(scene.materials.size() == native.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        CHECK(scene.materials[i].name == native.materials[i].name);
        CHECK(scene.materials[i].parameters == native.materials[i].parameters);
    }
    REQUIRE(scene.shapes.size() == 8);
    REQUIRE(native.shapes.size() == 8);
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
        CHECK(scene.shapes[i].material == native.shapes[i].material);
        CHECK(scene.shapes[i].transform == native.shapes[i].transform);
        CHECK(scene.shapes[i].geometry.index() == native.shapes[i].geometry.index());
        if (i < 7)
            CHECK(std::get<MeshFile>(scene.shapes[i].geometry).file ==
                  std::get<MeshFile>(native.shapes[i].geometry).file);
    }
}

TEST_CASE("the light is a one-sided rectangle that faces down", "[host]")
{
    const Scene scene =
        parse_scene(R"({"light_config": {"position": [1, 2, 3], "size": [4, 6], "radiance": [7, 8, 9]}})", "a.json")
            .scene;
    const ShapeDescription& light = scene.shapes.back();
    CHECK(std::get<RectangleShape>(light.geometry).size == Vec2(4, 6));
    CHECK(light.emission->radiance == Vec3(7, 8, 9));
    CHECK_FALSE(light.emission->two_sided);
    CHECK(apply(light.transform, {2, 0, 0}) == Vec3(3, 2, 3));
    CHECK(apply(light.transform, {0, 3, 0}) == Vec3(1, 2, 6));
    CHECK(Vec3(light.transform * Vec4(0, 0, 1, 0)) == Vec3(0, -1, 0));
    CHECK(scene.materials[light.material].parameters == std::vector<double>{0, 0, 0});
}

TEST_CASE("what a course file leaves out has the course's values", "[host]")
{
    const Scene scene = parse_scene(R"({"cam_config": {}})", "a.json").scene;
    CHECK(scene.camera.position == Vec3(0, 1, 6.8));
    CHECK(scene.camera.vertical_fov == 19.5);
    CHECK(scene.sampler.samples_per_pixel == 256);
    CHECK(scene.integrator.max_depth == 12u);
    CHECK(scene.film.width == 600);
    CHECK(scene.shapes.at(0).emission->radiance == Vec3(17, 12, 5));
}

TEST_CASE("specular is a mirror, translucent and glass are dielectrics of 1.5", "[host]")
{
    const Scene scene = parse_scene(course_text(R"({"name": "a", "type": "specular", "color": [0.9, 0.8, 0.7]},
        {"name": "b", "type": "translucent", "color": [1, 1, 0.5]}, {"name": "c", "type": "glass", "color": [1, 1, 1]},
        {"name": "d", "color": [0.1, 0.2, 0.3]})"),
                                    "a.json")
                            .scene;
    CHECK(scene.materials[0].bsdf == BSDF_MIRROR);
    CHECK(scene.materials[0].parameters == std::vector<double>{0.9, 0.8, 0.7});
    CHECK(scene.materials[1].bsdf == BSDF_DIELECTRIC);
    CHECK(scene.materials[1].parameters == std::vector<double>{1.5, 1, 1, 0.5});
    CHECK(scene.materials[2].bsdf == BSDF_DIELECTRIC);
    CHECK(scene.materials[3].bsdf == BSDF_DIFFUSE);
    CHECK(scene.materials[3].parameters == std::vector<double>{0.1, 0.2, 0.3});
}

TEST_CASE("a black glass is taken literally, with a warning", "[host]")
{
    const LoadedScene loaded =
        parse_scene(course_text(R"({"name": "ball", "type": "glass", "color": [0, 0, 0]})"), "a.json");
    CHECK(loaded.scene.materials[0].parameters == std::vector<double>{1.5, 0, 0, 0});
    CHECK(loaded.warnings ==
          std::vector<std::string>{"a.json: the glass material \"ball\" has the colour [0, 0, 0], taken "
                                   "literally: it is black."});
}

TEST_CASE("unknown keys of a course file are one warning", "[host]")
{
    const LoadedScene loaded = parse_scene(R"({"cam_config": {"aperture": 2, "lens": 1}, "threads": 8,
        "materials": [{"name": "a", "color": [1, 1, 1], "roughness": 0.1}]})",
                                           "a.json");
    CHECK(loaded.warnings ==
          std::vector<std::string>{"a.json: these keys are unknown and ignored: /threads, "
                                   "/cam_config/aperture, /cam_config/lens, /materials/0/roughness."});
}

TEST_CASE("a mesh is found in the scene's folder and without leading dots in every folder above", "[host]")
{
    const fs::path root = fs::path(ETENDUE_BINARY_DIR) / "course_test";
    fs::remove_all(root);
    fs::create_directories(root / "scenes" / "deep");
    fs::create_directories(root / "assets");
    write_file((root / "assets" / "a.obj").string(), "v 0 0 0\n");
    const std::string file = (root / "scenes" / "deep" / "s.json").string();
    const auto found = [&](const std::string& path) {
        const Scene scene =
            parse_scene(course_text(R"({"name": "a", "color": [1, 1, 1]})",
                                    R"({"obj_file_path": ")" + path +
                                        R"(", "material_name": "a", "translate": [1, 2, 3], "scale": 2})"),
                        file)
                .scene;
        CHECK(apply(scene.shapes[0].transform, {1, 1, 1}) == Vec3(3, 4, 5));
        return fs::weakly_canonical(fs::path(scene.folder) / std::get<MeshFile>(scene.shapes[0].geometry).file);
    };
    const fs::path expected = fs::weakly_canonical(root / "assets" / "a.obj");
    CHECK(found("../../assets/a.obj") == expected);
    CHECK(found("../assets/a.obj") == expected);
    CHECK(found("assets/a.obj") == expected);
    CHECK(found("../../../../assets/a.obj") == expected);
    CHECK(found((root / "assets" / "a.obj").string()) == expected);
    fs::remove_all(root);
}

TEST_CASE("a mesh that is nowhere names every place that was tried, once", "[host]")
{
    const std::string object = R"({"obj_file_path": "../assets/no_such_mesh.obj", "material_name": "a"})";
    try {
        parse_scene(course_text(R"({"name": "a", "color": [1, 1, 1]})", object), "/x/y/s.json");
        FAIL("no error");
    } catch (const SceneError& e) {
        const std::string message = e.what();
        const std::string first = "the mesh file does not exist; tried:\n    /x/y/../assets/no_such_mesh.obj\n"
                                  "    ../assets/no_such_mesh.obj\n    /x/y/assets/no_such_mesh.obj\n";
        CHECK(message.find(first) != std::string::npos);
        CHECK(message.find("\n    /assets/no_such_mesh.obj\n") != std::string::npos);
        CHECK(message.find("\n    /x/assets/no_such_mesh.obj\n") == std::string::npos);
        CHECK(message.find((fs::current_path() / "assets/no_such_mesh.obj").string()) != std::string::npos);
    }
}

TEST_CASE("NURBS are refused by name unless they are switched off", "[host]")
{
    const std::string material = R"({"name": "a", "color": [1, 1, 1]})";
    const auto with = [&](const std::string& key) {
        return course_text(material, R"({"obj_file_path": "meshes/left.obj", "material_name": "a", )" + key + "}");
    };
    const std::string refusal = "NURBS surfaces are not supported";
    CHECK_THROWS_WITH(parse_scene(with("\"is_NURBS\": true"), COURSE_BOX + "a.json"), Catch::Contains(refusal));
    CHECK_THROWS_WITH(parse_scene(with("\"nurbs\": {\"degree\": 3}"), COURSE_BOX + "a.json"), Catch::Contains(refusal));
    CHECK_THROWS_WITH(parse_scene(R"({"cam_config": {}, "nurbs": [{}]})", "a.json"), Catch::Contains(refusal));
    CHECK_NOTHROW(parse_scene(with("\"is_NURBS\": false"), COURSE_BOX + "a.json"));
}
