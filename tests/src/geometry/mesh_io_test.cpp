// Mesh files on disk: every encoding of a mesh is the same mesh, and no bytes crash the readers.
#include "geometry/mesh_io.h"

#include "support/child_process.h"
#include "util/error.h"
#include "util/file.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <random>

using namespace etendue;

namespace
{
// A bent strip of quads with a normal per vertex.
struct Strip {
    std::vector<Vec3> positions, normals;
    std::vector<std::vector<unsigned>> faces;
};

Strip make_strip()
{
    Strip strip;
    for (unsigned i = 0; i <= 5; ++i)
        for (unsigned j = 0; j < 2; ++j) {
            strip.positions.emplace_back(0.1 * i, 1.0 / 3.0 * j, std::sin(0.1 * i));
            strip.normals.emplace_back(-std::cos(0.1 * i), 0.0, 1.0);
        }
    for (unsigned i = 0; i < 5; ++i) strip.faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    return strip;
}

std::string as_obj(const Strip& strip)
{
    std::string text;
    for (const Vec3& p : strip.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const Vec3& n : strip.normals) text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
    for (const auto& face : strip.faces) {
        text += "f";
        for (const unsigned i : face) text += fmt::format(" {0}//{0}", i + 1);
        text += "\n";
    }
    return text;
}

template<class T>
void append(std::string& text, T value, bool swap)
{
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (swap) std::reverse(raw, raw + sizeof(T));
    text.append(raw, sizeof(T));
}

std::string ply_header(const Strip& strip, const std::string& format)
{
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "property double nx\nproperty double ny\nproperty double nz\nelement face {}\n"
        "property list uchar int vertex_indices\nend_header\n",
        format, strip.positions.size(), strip.faces.size());
}

std::string as_text_ply(const Strip& strip)
{
    std::string text = ply_header(strip, "ascii");
    for (std::size_t i = 0; i < strip.positions.size(); ++i) {
        const Vec3 p = strip.positions[i], n = strip.normals[i];
        text += fmt::format("{} {} {} {} {} {}\n", p.x, p.y, p.z, n.x, n.y, n.z);
    }
    for (const auto& f : strip.faces) text += fmt::format("4 {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    return text;
}

std::string as_binary_ply(const Strip& strip, bool big_endian)
{
    const bool swap = big_endian == (std::endian::native == std::endian::little);
    std::string text = ply_header(strip, big_endian ? "binary_big_endian" : "binary_little_endian");
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
        for (const Vec3& v : {strip.positions[i], strip.normals[i]})
            for (int k = 0; k < 3; ++k) append(text, v[k], swap);
    for (const auto& face : strip.faces) {
        append(text, std::uint8_t{4}, swap);
        for (const unsigned i : face) append(text, static_cast<std::int32_t>(i), swap);
    }
    return text;
}
} // namespace

TEST_CASE("a mesh gives the same triangles from OBJ and from every encoding of PLY")
{
    const TemporaryFolder folder;
    const Strip strip = make_strip();
    const auto written = [&](const std::string& name, const std::string& content) {
        const std::string path = (folder.path() / name).string();
        write_file(path, content);
        std::uint64_t bytes = 7;
        const Mesh mesh = read_mesh(path, {false, &bytes});
        CHECK(bytes == 7 + content.size());
        return mesh;
    };
    const Mesh obj = written("strip.OBJ", as_obj(strip));
    REQUIRE(obj.indices.size() == 10);
    CHECK(obj.positions == strip.positions);
    CHECK(obj.normals == strip.normals);
    const Mesh others[] = {written("text.ply", as_text_ply(strip)), written("little.ply", as_binary_ply(strip, false)),
                           written("big.ply", as_binary_ply(strip, true)), written("no-extension", as_text_ply(strip))};
    for (const Mesh& mesh : others) {
        CHECK(mesh.positions == obj.positions);
        CHECK(mesh.normals == obj.normals);
        CHECK(mesh.indices == obj.indices);
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) CHECK(mesh.normals_of(i) == obj.normals_of(i));
    }
}

TEST_CASE("a mesh file that cannot be one is refused by name")
{
    const TemporaryFolder folder;
    const std::string missing = (folder.path() / "missing.obj").string();
    CHECK_THROWS_AS(read_mesh(missing), FileError);
    CHECK_THROWS_WITH(read_mesh(missing), missing + ": there is no such file.");
    CHECK_THROWS_AS(read_mesh(folder.path().string()), FileError);
    CHECK_THROWS_WITH(read_mesh("/dev/zero"), "/dev/zero: is a device or a pipe, not a mesh file.");
    CHECK_THROWS_WITH(parse_mesh("", "a.obj"), "a.obj: is empty.");
    CHECK_THROWS_WITH(parse_mesh("plywood", "a.ply"), "a.ply: is no PLY file: its first line is not \"ply\".");
    CHECK_THROWS_WITH(parse_mesh("solid", "a.stl"), "a.stl: mesh format \".stl\" is not known; there are: .obj, .ply.");
}

TEST_CASE("damaged mesh files are read or refused, but never crash")
{
    const Strip strip = make_strip();
    const std::pair<std::string, std::string> originals[] = {{as_obj(strip), "a.obj"},
                                                             {as_text_ply(strip), "a.ply"},
                                                             {as_binary_ply(strip, false), "a.ply"},
                                                             {as_binary_ply(strip, true), "a.ply"}};
    std::mt19937 random(3);
    int read = 0, refused = 0;
    for (int round = 0; round < 8000; ++round) {
        const auto& [content, name] = originals[round % 4];
        std::string damaged = content;
        const std::string pool = "0123456789-+./e \nfvn#,\xff" + std::string(1, '\0');
        for (unsigned change = 0, count = 1 + random() % 4; change < count; ++change) {
            const std::size_t at = random() % damaged.size();
            switch (random() % 4) {
            case 0:
                damaged[at] = static_cast<char>(random());
                break;
            case 1:
                damaged[at] = pool[random() % pool.size()];
                break;
            case 2:
                damaged.erase(at, 1 + random() % 8);
                break;
            default:
                damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 16));
                break;
            }
            if (damaged.empty()) damaged.push_back('x');
        }
        try {
            const Mesh mesh = parse_mesh(damaged, name, round % 8 < 4);
            for (const auto& t : mesh.indices) REQUIRE(std::max({t.x, t.y, t.z}) < mesh.positions.size());
            ++read;
        } catch (const FileError& error) {
            REQUIRE(std::string(error.what()).starts_with(name));
            ++refused;
        }
    }
    CHECK(read > 500);
    CHECK(refused > 500);
}
