// PLY headers: what they may declare, and every message.
#include "geometry/ply_header.h"

#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;

TEST_CASE("a PLY header declares elements and properties in any order, with comments, in either line ending")
{
    const PlyHeader header = parse_ply_header("ply\r\ncomment a b\r\nformat binary_big_endian 1.0\r\nelement face 7\r\n"
                                              "property list uint8 int32 vertex_index\r\nproperty uchar flag\r\n"
                                              "obj_info x\r\n\r\nelement vertex 3\r\nproperty double x\r\n"
                                              "end_header\r\nBODY",
                                              "a.ply");
    CHECK(header.encoding == PlyEncoding::binary_big_endian);
    CHECK(header.body == "BODY");
    CHECK(header.lines == 11);
    REQUIRE(header.elements.size() == 2);
    const PlyElement& face = header.elements[0];
    CHECK(face.name == "face");
    CHECK(face.count == 7);
    REQUIRE(face.properties.size() == 2);
    CHECK(face.properties[0].is_list);
    CHECK(face.properties[0].count_type == PlyType::uint8);
    CHECK(face.properties[0].type == PlyType::int32);
    CHECK(face.least_size(header.encoding) == 2);
    CHECK(header.elements[1].least_size(header.encoding) == 8);
    CHECK(header.elements[1].least_size(PlyEncoding::text) == 2);
}

TEST_CASE("every fault of a PLY header is named with its line")
{
    const auto fails = [](const std::string& lines, const std::string& message) {
        INFO(lines);
        CHECK_THROWS_AS(parse_ply_header("ply\n" + lines, "a.ply"), FileError);
        CHECK_THROWS_WITH(parse_ply_header("ply\n" + lines, "a.ply"), "a.ply:" + message);
    };
    fails("format ascii 1.0\n", "2: the header ends without \"end_header\".");
    fails("end_header\n", "2: the header has no \"format\" line.");
    fails("format text 1.0\n",
          "2: format \"text\" is not known; there are: ascii, binary_little_endian, binary_big_endian.");
    fails("format ascii 2.0\n", "2: PLY version \"2.0\" is not known; there is 1.0.");
    fails("format ascii 1.0\nelements 3\n",
          "3: expected format, element, property, comment, obj_info or end_header, found \"elements\".");
    fails("element vertex many\n", "2: expected \"element NAME COUNT\" with a whole number, found \"many\".");
    fails("element vertex -1\n", "2: expected \"element NAME COUNT\" with a whole number, found \"-1\".");
    fails("element vertex\n", "2: expected \"element NAME COUNT\" with a whole number, found \"\".");
    fails("element vertex 1\nelement vertex 1\n", "3: element \"vertex\" is declared twice.");
    fails("property float x\n", "2: a property comes before the first element.");
    fails("element vertex 1\nproperty float x\nproperty int x\n", "4: property \"x\" is declared twice.");
    fails("element vertex 1\nproperty float\n", "3: expected the name of the property, found the end of the line.");
    fails(
        "element vertex 1\nproperty half x\n",
        "3: type \"half\" is not known; there are: char, uchar, short, ushort, int, uint, float, double, int8, uint8, "
        "int16, uint16, int32, uint32, float32, float64.");
    fails("element face 1\nproperty list float int x\n", "3: the number of items of a list must have an integer type.");
}
