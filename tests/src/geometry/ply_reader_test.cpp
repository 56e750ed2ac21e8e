// PLY bodies: every encoding and type, and every message.
#include "geometry/ply_reader.h"

#include "math/shared.h"
#include "util/error.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>

using namespace etendue;

namespace
{
Mesh read(const std::string& bytes)
{
    return triangulate(parse_ply(bytes, "a.ply"), "a.ply", false);
}

// Appends numbers as bytes of either order.
struct Bytes {
    bool big_endian;
    std::string text;

    template<class T>
    Bytes& add(T value)
    {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        const bool native_is_big = std::endian::native == std::endian::big;
        if (big_endian != native_is_big) std::reverse(raw, raw + sizeof(T));
        text.append(raw, sizeof(T));
        return *this;
    }
};

const std::string TRIANGLE =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string CORNERS = "0 0 0\n1 0 0\n0 1 0\n";

std::string binary_header(bool big_endian, const std::string& declarations)
{
    return std::string("ply\nformat ") + (big_endian ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
           declarations + "end_header\n";
}
} // namespace

TEST_CASE("a PLY text may have blank lines, faces first, polygons and properties that do not concern us")
{
    const Mesh mesh =
        read("ply\nformat ascii 1.0\nelement face 2\nproperty uchar red\nproperty list uchar float "
             "weights\nproperty list int uint vertex_index\nelement empty 1000000000\nelement edge "
             "1\nproperty int vertex1\nproperty int vertex2\nelement vertex 4\nproperty float z\nproperty "
             "double x\nproperty list uchar int others\nproperty float y\nend_header\n"
             "255 2 0.5 0.5 4 0 1 2 3\n\n0 0 3 2 1 0\n0 1\n\n 7 0 0 0\n7 1 2 5 5 0\n7 1 0 1\r\n7 0 0 1\n\n");
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 7}, {1, 0, 7}, {1, 1, 7}, {0, 1, 7}});
    CHECK(mesh.indices == std::vector<glm::u32vec3>{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}});
    CHECK(mesh.normals.empty());
}

TEST_CASE("binary PLY of either byte order carries every type of number exactly")
{
    for (const bool big_endian : {false, true}) {
        INFO(big_endian);
        Bytes bytes{big_endian,
                    binary_header(big_endian, "element vertex 3\nproperty char x\nproperty short y\nproperty "
                                              "ushort a\nproperty double z\nproperty float nx\nproperty "
                                              "uchar ny\nproperty int nz\nelement other 1\nproperty list "
                                              "ushort short list\nelement face 1\nproperty list int ushort "
                                              "vertex_indices\nproperty uint b\n")};
        for (int i = 0; i < 3; ++i) {
            bytes.add(static_cast<std::int8_t>(-100 * (i == 0))).add(static_cast<std::int16_t>(-300 * (i == 1)));
            bytes.add(std::uint16_t{65535})
                .add(0.1 * (i == 2))
                .add(0.25f)
                .add(std::uint8_t{200})
                .add(std::int32_t{-70000});
        }
        bytes.add(std::uint16_t{2}).add(std::int16_t{1}).add(std::int16_t{2});
        bytes.add(std::int32_t{3})
            .add(std::uint16_t{2})
            .add(std::uint16_t{0})
            .add(std::uint16_t{1})
            .add(std::uint32_t{9});
        const Mesh mesh = read(bytes.text);
        CHECK(mesh.positions == std::vector<Vec3>{{-100, 0, 0}, {0, -300, 0}, {0, 0, 0.1}});
        CHECK(mesh.indices == std::vector<glm::u32vec3>{{2, 0, 1}});
        REQUIRE(mesh.normals.size() == 3);
        CHECK(mesh.normals[2] == Vec3(0.25, 200, -70000));
        CHECK(mesh.normals_of(0) == glm::u32vec3(2, 0, 1));
    }
}

TEST_CASE("every fault of a PLY text is named with its line")
{
    const auto fails = [](const std::string& text, const std::string& message) {
        INFO(text);
        CHECK_THROWS_AS(read(text), FileError);
        CHECK_THROWS_WITH(read(text), message);
    };
    const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string format = "ply\nformat ascii 1.0\n";
    fails(format + vertex + "end_header\n0 0 0\n", "a.ply: has no element \"face\" (only faces can be rendered).");
    fails(format + "element face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 0 0\n",
          "a.ply: has no element \"vertex\".");
    fails(format + "element vertex 1\nproperty float x\nproperty list uchar float y\nproperty float z\nelement face "
                   "0\nend_header\n0 0 0 0 0\n",
          "a.ply: element vertex needs the properties x, y and z.");
    fails(format + vertex + "element face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 0\n0\n",
          "a.ply: element face needs a list of integers \"vertex_indices\".");
    fails(format + vertex + "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
          "a.ply: has no faces.");
    fails(format + vertex +
              "property list int int ring\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n0 0 0 -1\n3 0 0 0\n",
          "a.ply:11: list \"ring\" has -1 items.");
    fails(TRIANGLE + "0 0 0\n1 0\n0 1 0 0 0\n3 0 1 2\n",
          "a.ply:11: expected a number with a decimal point, found the end of the line.");
    fails(TRIANGLE + "0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "a.ply:11: expected the end of the line, found \"7\".");
    fails(TRIANGLE + "0 0 0\n1 0 0\n0 1,5 0\n3 0 1 2\n",
          "a.ply:12: expected a number with a decimal point, found \"1,5\".");
    fails(TRIANGLE + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "a.ply: vertex 2 is at (0, nan, 0), which is not finite.");
    fails(TRIANGLE + CORNERS + "3 0 1 2.0\n", "a.ply:13: expected a whole number, found \"2.0\".");
    fails(TRIANGLE + CORNERS + "3 0 1\n", "a.ply:13: expected a whole number, found the end of the line.");
    fails(TRIANGLE + CORNERS + "3 0 1 -1\n", "a.ply:13: face 0 uses vertex -1, which is no index.");
    fails(TRIANGLE + CORNERS + "3 0 1 3\n", "a.ply: face 0 uses vertex 3, but the file has 3, numbered from 0.");
    fails(TRIANGLE + CORNERS + "2 0 1\n", "a.ply:13: face 0 has 2 corners; a face needs at least three.");
    fails(TRIANGLE + CORNERS + "-3 0 1\n", "a.ply:13: face 0 has -3 corners; a face needs at least three.");
    fails(TRIANGLE + CORNERS + " \n  ", "a.ply:14: the file ends before face 0 of 1.");
    fails(TRIANGLE + CORNERS + "3 0 1 2\n\n3 1 2 0\n",
          "a.ply:15: expected the end of the file, found \"3\"; the counts in the header are too small.");
}

TEST_CASE("a header that claims more than the file can hold is refused before memory is asked for")
{
    const auto header = [](const std::string& vertices, const std::string& faces) {
        return "element vertex " + vertices + "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
               faces + "\nproperty list uchar int vertex_indices\n";
    };
    CHECK_THROWS_WITH(read(binary_header(false, header("1000000000000", "1")) + "0123"),
                      "a.ply: the header claims 1000000000000 elements \"vertex\", but the rest of the file can hold 0 "
                      "at most.");
    CHECK_THROWS_WITH(
        read(binary_header(false, header("0", "9000000000000000000")) + "0123"),
        "a.ply: the header claims 9000000000000000000 elements \"face\", but the rest of the file can hold "
        "5 at most.");
    CHECK_THROWS_WITH(read("ply\nformat ascii 1.0\n" + header("1000000000000", "1") + "end_header\n0 0 0\n"),
                      "a.ply: the header claims 1000000000000 elements \"vertex\", but the rest of the file can hold 1 "
                      "at most.");
    Bytes list{false, binary_header(false, "element face 1\nproperty list uint uchar vertex_indices\nelement vertex "
                                           "0\nproperty float x\nproperty float y\nproperty float z\n")};
    list.add(0xffffffffu).add(std::uint8_t{1});
    CHECK_THROWS_WITH(read(list.text),
                      "a.ply: byte " + std::to_string(list.text.size()) + ": the file ends within face 0 of 1.");
}

TEST_CASE("a binary PLY that is cut off or goes on is refused, wherever that happens")
{
    const std::string header =
        binary_header(false, "element vertex 3\nproperty float x\nproperty float y\nproperty float "
                             "z\nelement face 1\nproperty list uchar int vertex_indices\n");
    Bytes bytes{false, header};
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes.add(value);
    bytes.add(std::uint8_t{3}).add(0).add(1).add(2);
    CHECK(read(bytes.text).indices.size() == 1);
    CHECK(read(bytes.text + "\n").indices.size() == 1);
    for (std::size_t size = 0; size < bytes.text.size(); ++size) {
        INFO(size);
        CHECK_THROWS_AS(read(bytes.text.substr(0, size)), FileError);
    }
    CHECK_THROWS_WITH(read(bytes.text.substr(0, bytes.text.size() - 1)),
                      "a.ply: byte " + std::to_string(bytes.text.size() - 4) + ": the file ends within face 0 of 1.");
    CHECK_THROWS_WITH(read(bytes.text + "abc"),
                      "a.ply: byte " + std::to_string(bytes.text.size()) +
                          ": 3 bytes follow the last element; the counts in the header are too "
                          "small.");
}
