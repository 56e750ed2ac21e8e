// Shapes in world space, and the triangles that no ray can meet.
#include "geometry/placed_shapes.h"

#include <catch2/catch.hpp>

using namespace etendue;

namespace
{
template<class Shape>
Scene scene_of(const Shape& geometry, const Mat4& transform = Mat4(1.0))
{
    Scene scene;
    ShapeDescription shape;
    shape.name = "s";
    shape.location.pointer = "/shapes/0";
    shape.geometry = geometry;
    shape.transform = transform;
    scene.shapes.push_back(shape);
    return scene;
}

PlacedShapes place(const Scene& scene)
{
    GeometryStatistics statistics;
    std::vector<std::string> warnings;
    return place_shapes(scene, {}, statistics, warnings);
}

Mat4 columns(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& t)
{
    return {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(t, 1)};
}
} // namespace

TEST_CASE("spheres and disks go through similarities only")
{
    const Mat4 turned = columns({0, 2, 0}, {0, 0, 2}, {2, 0, 0}, {1, 2, 3});
    const PlacedShapes sphere = place(scene_of(SphereShape{1.5}, turned));
    REQUIRE(sphere.spheres.size() == 1);
    CHECK(sphere.spheres[0].centre == Vec3(1, 2, 3));
    CHECK(sphere.spheres[0].radius == 3.0);
    CHECK(sphere.bounds().lower == Vec3(-2, -1, 0));
    CHECK(sphere.bounds().upper == Vec3(4, 5, 6));

    const PlacedShapes disk = place(scene_of(DiskShape{1.5}, turned));
    REQUIRE(disk.disks.size() == 1);
    CHECK(disk.disks[0].normal == Vec3(1, 0, 0));
    CHECK(disk.disks[0].radius == 3.0);
    CHECK(disk.bounds().lower == Vec3(1, -1, 0));
    CHECK(disk.bounds().upper == Vec3(1, 5, 6));

    const Mat4 stretched = columns({1, 0, 0}, {0, 2, 0}, {0, 0, 1}, {0, 0, 0});
    CHECK_THROWS_AS(place(scene_of(SphereShape{}, stretched)), SceneError);
    CHECK_THROWS_WITH(place(scene_of(SphereShape{}, stretched)),
                      "/shapes/0: the transform of a sphere must be made of rotations, translations and the same scale "
                      "along every axis.");
    CHECK_THROWS_WITH(place(scene_of(DiskShape{}, stretched)),
                      "/shapes/0: the transform of a disk must be made of rotations, translations and the same scale "
                      "along every axis.");
    CHECK_THROWS_WITH(place(scene_of(DiskShape{0.0})), "/shapes/0: the radius must be positive and finite, is 0.");
    CHECK_THROWS_WITH(place(scene_of(SphereShape{}, columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, NAN, 0}))),
                      "/shapes/0: the centre of the shape is not finite.");
}

TEST_CASE("inline triangles with wrong indices or normals are refused")
{
    CHECK_THROWS_WITH(place(scene_of(InlineTriangles{{Vec3(0.0)}, {}, {{0, 0, 0}, {0, 1, 0}}})),
                      "/shapes/0: triangle 1 uses vertex 1, but there are 1, numbered from 0.");
    CHECK_THROWS_WITH(place(scene_of(InlineTriangles{{Vec3(0.0), Vec3(1.0)}, {Vec3(1.0)}, {}})),
                      "/shapes/0: there are 1 normals for 2 vertices.");
}

TEST_CASE("triangles without area or with corners that are not finite are refused by number, or dropped")
{
    InlineTriangles triangles;
    triangles.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {NAN, 0, 0}, {2, 0, 0}, {1e-12, 0, 0}};
    const auto refused = [&](const glm::u32vec3& bad, const std::string& message) {
        InlineTriangles some = triangles;
        some.indices = {{0, 1, 2}, bad, {1, 2, 4}};
        const Scene scene = scene_of(some);
        PlacedShapes shapes = place(scene);
        const auto drop = [&](bool lenient) {
            return drop_non_finite(shapes, scene, lenient) + drop_flat(shapes, scene, lenient, {});
        };
        CHECK_THROWS_AS(drop(false), SceneError);
        CHECK_THROWS_WITH(drop(false), "/shapes/0: triangle 1 of shape \"s\" " + message);
        CHECK(drop(true) == 1);
        CHECK(shapes.meshes[0].mesh.indices == std::vector<glm::u32vec3>{{0, 1, 2}, {1, 2, 4}});
        CHECK(drop(false) == 0);
    };
    refused({0, 1, 3}, "has a corner that is not finite; --lenient drops such triangles.");
    refused({0, 1, 0}, "has two corners in the same place (as far as single precision can tell); --lenient drops such "
                       "triangles.");
    refused({0, 1, 4}, "has no area: its corners lie on one line; --lenient drops such triangles.");
}

TEST_CASE("corners that single precision cannot tell apart are one corner, slivers that it can are kept")
{
    InlineTriangles triangles;
    triangles.positions = {{1, 0, 0}, {1 + 1e-9, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e-7, 1, 0}, {0, 1, 1e-30}};
    const auto dropped = [&](const glm::u32vec3& triangle) {
        triangles.indices = {triangle};
        const Scene scene = scene_of(triangles);
        PlacedShapes shapes = place(scene);
        return drop_flat(shapes, scene, true, {});
    };
    CHECK(dropped({0, 1, 2}) == 1);
    CHECK(dropped({3, 2, 4}) == 0);
    CHECK(dropped({3, 2, 0}) == 0);
    CHECK(dropped({0, 2, 5}) == 0);
}

TEST_CASE("triangles keep their own normals when others are dropped before them")
{
    const Scene scene = scene_of(InlineTriangles{});
    PlacedMesh placed;
    placed.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    placed.mesh.normals = {{0, 0, 1}, {1, 0, 0}};
    placed.mesh.indices = {{0, 1, 1}, {0, 1, 2}};
    placed.mesh.normal_indices = {{0, 0, 0}, {1, 1, 0}};
    PlacedShapes shapes;
    shapes.meshes.push_back(placed);
    CHECK(drop_flat(shapes, scene, true, {}) == 1);
    CHECK(shapes.triangle_count() == 1);
    CHECK(shapes.meshes[0].mesh.normal_indices == std::vector<glm::u32vec3>{{1, 1, 0}});
}

TEST_CASE("every coordinate is rounded to float", "[geometry]")
{
    // Optimised code too, which may take three conversions for one.
    const Vec3 place = rounded(Vec3(0.1, 0.2, 0.3), Normalisation{});
    CHECK(place.x == double(0.1f));
    CHECK(place.y == double(0.2f));
    CHECK(place.z == double(0.3f));
}
