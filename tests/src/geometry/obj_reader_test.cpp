// OBJ: what it may look like, and every message.
#include "geometry/obj_reader.h"

#include "math/shared.h"
#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
const std::string SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Mesh read(const std::string& text)
{
    return triangulate(parse_obj(text, "a.obj"), "a.obj", false);
}
} // namespace

TEST_CASE("every way to write the corners of an OBJ face gives the same triangle")
{
    const std::string parts = SQUARE + "vn 0 0 1\nvn 0 0 -1\nvt 0 0\n";
    for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f -4 -3 -2", "f +1 2 3 # comment", "f 1 2 3\r"}) {
        INFO(face);
        const Mesh mesh = read(parts + face);
        CHECK(mesh.indices == std::vector<glm::u32vec3>{{0, 1, 2}});
        CHECK(mesh.normals_of(0) == glm::u32vec3(NO_INDEX));
    }
    for (const char* face :
         {"f 1//2 2//2 3//1", "f 1/1/2 2/1/2 3/1/1", "f -4//-1 -3//-1 -2//-2", "f 1//2 2/1/2 3//1"}) {
        INFO(face);
        const Mesh mesh = read(parts + face);
        CHECK(mesh.indices == std::vector<glm::u32vec3>{{0, 1, 2}});
        CHECK(mesh.normals_of(0) == glm::u32vec3(1, 1, 0));
    }
}

TEST_CASE("an OBJ file may mix faces with and without normals, sizes of faces, colours, and vertices after faces")
{
    const Mesh mesh =
        read("f 1//1 2//1 3//1 4//1\nf 1 2 3\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n");
    REQUIRE(mesh.indices.size() == 3);
    CHECK(mesh.normals_of(1) == glm::u32vec3(0));
    CHECK(mesh.normals_of(2) == glm::u32vec3(NO_INDEX));
    CHECK(mesh.positions[2] == Vec3(1, 1, 0));
}

TEST_CASE("statements that do not concern triangles are skipped, unknown ones with one warning")
{
    CHECK(read("mtllib x.mtl\no x\ng x\ns 1\nusemtl x\n\n# x\n" + SQUARE + "f 1 2 3\nl 1 2").warnings.empty());
    const Mesh mesh = read("hello\n" + SQUARE + "f 1 2 3\nworld 1\n");
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0] == "a.obj:1: statement \"hello\" is not known and was skipped; so were 1 others.");
}

TEST_CASE("every fault of an OBJ file is named with its line")
{
    const auto fails = [](const std::string& text, const std::string& message) {
        INFO(text);
        CHECK_THROWS_AS(read(text), FileError);
        CHECK_THROWS_WITH(read(text), message);
    };
    fails("v 0 0 0\nv 1 0\n", "a.obj:2: expected three numbers, found the end of the line.");
    fails("v 0 0 0,5\n", "a.obj:1: expected a number with a decimal point, found \"0,5\".");
    fails("v 0 0 x\n", "a.obj:1: expected a number with a decimal point, found \"x\".");
    fails("v 0 0 0 y\n", "a.obj:1: expected a number with a decimal point, found \"y\".");
    fails("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj: vertex 1 is at (nan, 0, 0), which is not finite.");
    fails("v 0 0 0\nv 1 -inf 0\nv 0 1 0\nf 1 2 3\n", "a.obj: vertex 2 is at (1, -inf, 0), which is not finite.");
    fails("v 0 0 0\nv 1 1e999 0\nv 0 1 0\nf 1 2 3\n", "a.obj: vertex 2 is at (1, inf, 0), which is not finite.");
    for (const char* corner : {"x", "1/", "1//", "1/1/", "/1", "1/x", "1//1/1", "1.5", "99999999999999999999"}) {
        const std::string message =
            "a.obj:5: expected a corner such as 1, 1/2, 1//3 or 1/2/3, found \"" + std::string(corner) + "\".";
        fails(SQUARE + "f 2 3 " + corner, message);
    }
    fails(SQUARE + "f 1 2 3\nf 1 2 5\n", "a.obj:6: face 2 uses vertex 5, but the file has 4, numbered from 1.");
    fails(SQUARE + "f 1 2 -5\n", "a.obj:5: face 1 uses vertex -5, but there are 4 so far, numbered from 1.");
    fails(SQUARE + "f 0 1 2\n", "a.obj:5: face 1 uses vertex 0, but there are 4 so far, numbered from 1.");
    fails(SQUARE + "f 1 2 4294967296\n",
          "a.obj:5: face 1 uses vertex 4294967296, but there are 4 so far, numbered from 1.");
    fails(SQUARE + "vn 0 0 1\nf 1//1 2//1 3//2\n",
          "a.obj:6: face 1 uses normal 2, but the file has 1, numbered from 1.");
    fails(SQUARE + "f 1//1 2//1 3//1\n", "a.obj:5: face 1 uses normal 1, but the file has 0, numbered from 1.");
    fails(SQUARE + "vn 0 0 1\nf 1//1 2 3\n", "a.obj:6: some corners of the face have a normal and some have none.");
    fails(SQUARE + "f 1 2\n", "a.obj:5: face 1 has 2 corners; a face needs at least three.");
    fails(SQUARE + "f\n", "a.obj:5: face 1 has 0 corners; a face needs at least three.");
    fails(SQUARE, "a.obj: has no faces.");
    fails("# nothing\n", "a.obj: has no faces.");
}
