// Rectangles and boxes.
#include "geometry/shapes.h"

#include <catch2/catch.hpp>
#include <map>
#include <utility>

using namespace etendue;

namespace
{
Vec3 area_vector(const Mesh& mesh, const glm::u32vec3& t)
{
    return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]) / 2.0;
}
} // namespace

TEST_CASE("a rectangle is two triangles of half its area that face +z")
{
    const Mesh mesh = make_mesh(RectangleShape{{2, 3}});
    REQUIRE(mesh.indices.size() == 2);
    for (const auto& t : mesh.indices) CHECK(area_vector(mesh, t) == Vec3(0, 0, 3));
    CHECK(mesh.positions[mesh.indices[0].x] == Vec3(-1, -1.5, 0));
}

TEST_CASE("a box is closed, faces outward and has the area of its size")
{
    const Mesh mesh = make_mesh(BoxShape{{1, 2, 4}});
    REQUIRE(mesh.indices.size() == 12);
    std::map<std::pair<unsigned, unsigned>, int> edges;
    double area = 0.0, volume = 0.0;
    for (const auto& t : mesh.indices) {
        const Vec3 n = area_vector(mesh, t);
        area += glm::length(n);
        volume += glm::dot(n, mesh.positions[t.x]) / 3.0;
        CHECK(glm::dot(n, mesh.positions[t.x]) > 0.0);
        for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
    CHECK(area == Approx(2 * (1 * 2 + 2 * 4 + 4 * 1)).epsilon(1e-14));
    CHECK(volume == Approx(8.0).epsilon(1e-14));
    REQUIRE(edges.size() == 36);
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
}
