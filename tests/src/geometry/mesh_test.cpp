// Polygons to triangles, and meshes through transforms.
#include "geometry/mesh.h"

#include "math/shared.h"
#include "math/transform.h"
#include "util/error.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
Mesh cut(const std::vector<Vec3>& corners)
{
    PolygonMesh polygons;
    polygons.positions = corners;
    polygons.sizes = {static_cast<std::uint32_t>(corners.size())};
    for (std::uint32_t i = 0; i < corners.size(); ++i) polygons.corners.push_back(i);
    return triangulate(std::move(polygons), "a", false);
}

Vec3 area_vector(const Mesh& mesh, std::size_t i)
{
    const auto t = mesh.indices[i];
    return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]) / 2.0;
}

// Check that the triangles of a polygon in z = 0 all face +z and have its area.
void check_polygon(const std::vector<Vec3>& corners, double area)
{
    const Mesh mesh = cut(corners);
    REQUIRE(mesh.indices.size() == corners.size() - 2);
    CHECK(mesh.warnings.empty());
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        CHECK(area_vector(mesh, i).z > 0.0);
        sum += area_vector(mesh, i).z;
    }
    CHECK(sum == Approx(area).epsilon(1e-14));
}
} // namespace

TEST_CASE("polygons are cut into triangles that all face the same way")
{
    check_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.5);
    check_polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 2.0);
    // An arrow: only the reflex corner and the one opposite see the whole of it.
    check_polygon({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}}, 1.0);
    check_polygon({{2, 1, 0}, {0, 2, 0}, {1, 1, 0}, {0, 0, 0}}, 1.0);
    // A corner on a straight edge: the fans of some corners have a triangle without area.
    check_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4.0);
}

TEST_CASE("a polygon that no corner sees whole is cut with a warning")
{
    // A comb with three teeth.
    const Mesh mesh = cut({{0, 0, 0},
                           {5, 0, 0},
                           {5, 3, 0},
                           {4, 3, 0},
                           {4, 1, 0},
                           {3, 1, 0},
                           {3, 3, 0},
                           {2, 3, 0},
                           {2, 1, 0},
                           {1, 1, 0},
                           {1, 3, 0},
                           {0, 3, 0}});
    CHECK(mesh.indices.size() == 10);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0] == "a: 1 faces with more than three corners are seen whole from none of their corners; cut "
                              "them into triangles before exporting.");
}

TEST_CASE("normals of a polygon's corners stay with their corners")
{
    PolygonMesh polygons;
    polygons.positions = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    polygons.normals = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}, {0, 0, 5}};
    polygons.sizes = {4};
    polygons.corners = {0, 1, 2, 3};
    polygons.normal_corners = {4, 3, 2, 1};
    const Mesh mesh = triangulate(std::move(polygons), "a", false);
    REQUIRE(mesh.indices.size() == 2);
    for (std::size_t i = 0; i < 2; ++i)
        for (int k = 0; k < 3; ++k) CHECK(mesh.normals_of(i)[k] == 4 - mesh.indices[i][k]);
}

TEST_CASE("positions that are not finite are refused, or kept when lenient")
{
    PolygonMesh polygons;
    polygons.positions = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
    polygons.sizes = {3};
    polygons.corners = {0, 1, 2};
    CHECK(triangulate(PolygonMesh(polygons), "a", true).indices.size() == 1);
    CHECK_THROWS_WITH(triangulate(std::move(polygons), "a", false),
                      "a: vertex 2 is at (0, nan, 0), which is not finite.");
}

TEST_CASE("a mirrored mesh keeps its sides: the winding turns with the mirror")
{
    Mesh mesh = cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    mesh.normals = {{0, 0, 2}, {0, 0, 0}, {1, 0, 1}};
    mesh.normal_indices = {{2, 1, 0}};
    Mat4 mirror(1.0);
    mirror[0][0] = -2.0;
    mirror[3] = Vec4(5, 0, 0, 1);
    transform_mesh(mesh, mirror);
    CHECK(area_vector(mesh, 0) == Vec3(0, 0, 1));
    CHECK(mesh.indices[0] == glm::u32vec3(0, 2, 1));
    CHECK(mesh.normals_of(0) == glm::u32vec3(2, 0, 1));
    CHECK(mesh.positions[1] == Vec3(3, 0, 0));
    CHECK(mesh.normals[0] == Vec3(0, 0, 1));
    CHECK(mesh.normals[1] == Vec3(0.0));
    CHECK(glm::length(mesh.normals[2] - glm::normalize(Vec3(-1, 0, 2))) <= 1e-15);
}
