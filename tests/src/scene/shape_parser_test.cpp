#include "scene/scene_loader.h"

using namespace etendue;

namespace
{
Scene parse(const std::string& shapes_and_lights)
{
    return parse_scene(R"({"materials": [{"name": "a", "type": "diffuse"}, {"name": "b", "type": "mirror"}], )" +
                           shapes_and_lights + "}",
                       "test.json")
        .scene;
}
} // namespace

TEST_CASE("every geometry is read with its keys", "[host]")
{
    const Scene scene = parse(R"("shapes": [
        {"name": "floor", "type": "rectangle", "size": [2, 3], "material": "b", "flip_normals": true},
        {"type": "box", "size": [1, 2, 3], "material": "a"},
        {"type": "disk", "radius": 4, "material": "a"},
        {"type": "sphere", "radius": 5, "material": "a", "transform": {"translate": [1, 2, 3]},
         "emission": {"radiance": [7, 8, 9], "two_sided": true}},
        {"type": "triangles", "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "normals": [[0, 0, 1], [0, 0, 1], [0, 1, 1]],
         "indices": [[0, 1, 2], [2, 1, 0]], "material": "a"}])");
    REQUIRE(scene.shapes.size() == 5);
    CHECK(scene.shapes[0].name == "floor");
    CHECK(scene.shapes[0].material == 1);
    CHECK(scene.shapes[0].flip_normals);
    CHECK_FALSE(scene.shapes[1].flip_normals);
    CHECK(std::get<RectangleShape>(scene.shapes[0].geometry).size == Vec2(2, 3));
    CHECK(std::get<BoxShape>(scene.shapes[1].geometry).size == Vec3(1, 2, 3));
    CHECK(std::get<DiskShape>(scene.shapes[2].geometry).radius == 4);
    CHECK(std::get<SphereShape>(scene.shapes[3].geometry).radius == 5);
    CHECK(scene.shapes[3].transform[3] == Vec4(1, 2, 3, 1));
    CHECK(scene.shapes[3].emission->radiance == Vec3(7, 8, 9));
    CHECK(scene.shapes[3].emission->two_sided);
    CHECK_FALSE(scene.shapes[2].emission.has_value());
    const auto& triangles = std::get<InlineTriangles>(scene.shapes[4].geometry);
    CHECK(triangles.positions.size() == 3);
    CHECK(triangles.normals[2] == Vec3(0, 1, 1));
    CHECK(triangles.indices[1] == glm::u32vec3(2, 1, 0));
    CHECK(scene.shapes[4].location.line == 7);
}

TEST_CASE("lights are shapes that emit, after the shapes, black unless they have a material", "[host]")
{
    const Scene scene = parse(R"("lights": [{"type": "disk", "radiance": 3}, {"type": "box", "radiance": [1, 2, 3],
        "two_sided": true, "material": "b"}, {"type": "sphere", "radiance": 1}],
        "shapes": [{"type": "sphere", "material": "a"}])");
    REQUIRE(scene.shapes.size() == 4);
    REQUIRE(scene.materials.size() == 3);
    CHECK_FALSE(scene.shapes[0].emission.has_value());
    CHECK(scene.shapes[1].emission->radiance == Vec3(3, 3, 3));
    CHECK_FALSE(scene.shapes[1].emission->two_sided);
    CHECK(scene.shapes[1].material == 2);
    CHECK(scene.shapes[2].material == 1);
    CHECK(scene.shapes[2].emission->two_sided);
    CHECK(scene.shapes[3].material == 2);
    CHECK(scene.materials[2].bsdf == BSDF_DIFFUSE);
    CHECK(scene.materials[2].parameters == std::vector<double>{0, 0, 0});
}
