// The meshes of our own scenes: scripts/gen_meshes and what it wrote.
#include "geometry/mesh_io.h"

#include "support/child_process.h"
#include "util/file.h"

#include <catch2/catch.hpp>
#include <map>
#include <utility>

using namespace etendue;

namespace
{
const std::string MESHES = ETENDUE_SOURCE_DIR "/scenes/course-box/meshes/";
const std::string SCRIPT = ETENDUE_SOURCE_DIR "/scripts/gen_meshes";

struct Measures {
    double area = 0.0;
    double volume = 0.0;  // enclosed, where the mesh is closed
    double agreement = 1; // least cosine between a triangle's normal and the vertex normals
    bool closed = true;   // every edge once in each direction
    Vec3 lower{1e9}, upper{-1e9};
};

Measures measure(const Mesh& mesh)
{
    Measures m;
    std::map<std::pair<unsigned, unsigned>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const auto t = mesh.indices[i], n = mesh.normals_of(i);
        const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const Vec3 cross = glm::cross(b - a, c - a);
        m.area += glm::length(cross) / 2;
        m.volume += glm::dot(cross, a) / 6;
        for (int k = 0; k < 3; ++k) {
            m.agreement = std::min(m.agreement, glm::dot(glm::normalize(cross), mesh.normals[n[k]]));
            ++edges[{t[k], t[(k + 1) % 3]}];
            m.lower = glm::min(m.lower, mesh.positions[t[k]]);
            m.upper = glm::max(m.upper, mesh.positions[t[k]]);
        }
    }
    for (const auto& [edge, count] : edges)
        m.closed = m.closed && count == 1 && edges.count({edge.second, edge.first}) == 1;
    return m;
}
} // namespace

TEST_CASE("the walls of the course box are two triangles each and face into the room")
{
    const std::pair<const char*, Vec3> walls[] = {
        {"left", {-1, 1, 0}}, {"right", {1, 1, 0}}, {"floor", {0, 0, 0}}, {"ceiling", {0, 2, 0}}, {"back", {0, 1, -1}}};
    for (const auto& [name, centre] : walls) {
        INFO(name);
        const Mesh mesh = read_mesh(MESHES + name + ".obj");
        REQUIRE(mesh.indices.size() == 2);
        const Measures m = measure(mesh);
        CHECK(m.area == 4.0);
        CHECK(m.agreement == 1.0);
        CHECK((m.lower + m.upper) / 2.0 == centre);
        CHECK(mesh.normals[mesh.normals_of(0).x] == Vec3(0, 1, 0) - centre);
    }
}

TEST_CASE("the boxes of the course box are closed, stand on the floor and face outward")
{
    // Footprint areas by the shoelace formula.
    const std::tuple<const char*, double, double> boxes[] = {{"short_box", 0.6, 0.359500}, {"tall_box", 1.2, 0.363000}};
    for (const auto& [name, height, footprint] : boxes) {
        INFO(name);
        const Mesh mesh = read_mesh(MESHES + name + ".obj");
        REQUIRE(mesh.indices.size() == 12);
        const Measures m = measure(mesh);
        CHECK(m.closed);
        CHECK(m.agreement >= 1.0 - 1e-12);
        CHECK(m.lower.y == 0.0);
        CHECK(m.upper.y == height);
        CHECK(m.volume == Approx(footprint * height).epsilon(1e-5));
    }
}

TEST_CASE("scripts/gen_meshes writes the course box as it is committed")
{
    const TemporaryFolder folder;
    REQUIRE(run_child(SCRIPT, {folder.path().string()}).exit_code == 0);
    for (const char* name : {"left", "right", "floor", "ceiling", "back", "short_box", "tall_box"}) {
        INFO(name);
        CHECK(read_file((folder.path() / (std::string(name) + ".obj")).string()) == read_file(MESHES + name + ".obj"));
    }
}

TEST_CASE("the large mesh is a closed knot of as many triangles as asked for, about a metre across")
{
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "meshes" / "knot.ply").string();
    REQUIRE(run_child(SCRIPT, {"--large", "30000", path}).exit_code == 0);
    const Mesh mesh = read_mesh(path);
    CHECK(mesh.indices.size() == 30000);
    const Measures m = measure(mesh);
    CHECK(m.closed);
    CHECK(m.volume > 0.02);
    CHECK(m.agreement > 0.7);
    const Vec3 size = m.upper - m.lower;
    CHECK(std::max({size.x, size.y, size.z}) == Approx(1.0).margin(0.15));
    CHECK(glm::length(m.upper + m.lower) < 0.1);
    for (const Vec3& normal : mesh.normals) REQUIRE(std::abs(glm::length(normal) - 1.0) < 1e-6);
}

TEST_CASE("a number of triangles that makes no closed knot is refused")
{
    const TemporaryFolder folder;
    const ChildResult result = run_child(SCRIPT, {"--large", "601", (folder.path() / "knot.ply").string()});
    CHECK(result.exit_code == 1);
    CHECK(result.errors ==
          "gen_meshes: 601 triangles make no closed grid; take 2 * a * b with a and b of at least 3.\n");
    CHECK(std::filesystem::is_empty(folder.path()));
}
