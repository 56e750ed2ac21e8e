// From a scene to the arrays of a device.
#include "geometry/geometry.h"

#include "scene/material_parser.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>

using namespace etendue;

namespace
{
Vec3 vec3(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}

template<class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_bits(const Geometry& a, const Geometry& b)
{
    return same_bits(a.primitives, b.primitives) && same_bits(a.surfaces, b.surfaces) &&
           same_bits(a.normals, b.normals) && same_bits(a.lights, b.lights) &&
           same_bits(a.light_table, b.light_table) && std::memcmp(&a.camera, &b.camera, sizeof(Camera)) == 0 &&
           std::memcmp(&a.bounding_sphere, &b.bounding_sphere, sizeof(real4)) == 0;
}

template<class Shape>
ShapeDescription make_shape(const Shape& geometry, const Mat4& transform = Mat4(1.0))
{
    ShapeDescription shape;
    shape.name = "s";
    shape.location.pointer = "/shapes/0";
    shape.geometry = geometry;
    shape.transform = transform;
    return shape;
}

template<class Shape>
Scene scene_of(const Shape& geometry, const Mat4& transform = Mat4(1.0))
{
    Scene scene;
    scene.file = "s.json";
    scene.materials.push_back(default_material(BSDF_DIFFUSE));
    scene.shapes.push_back(make_shape(geometry, transform));
    return scene;
}

Mat4 placed(double scale, const Vec3& translation)
{
    Mat4 m(scale);
    m[3] = Vec4(translation, 1);
    return m;
}

// One of everything, in coordinates of few bits, moved and scaled as a whole.
Scene scene_of_everything(double scale, const Vec3& translation)
{
    std::mt19937 random(4);
    const auto coordinate = [&random] { return std::ldexp(static_cast<double>(random() % 4096), -10) - 2.0; };
    InlineTriangles triangles;
    for (unsigned i = 0; i < 60; ++i) {
        triangles.positions.emplace_back(coordinate(), coordinate(), coordinate());
        triangles.normals.emplace_back(coordinate(), coordinate(), coordinate());
        if (i % 3 == 2) triangles.indices.emplace_back(i - 2, i - 1, i);
    }
    Scene scene = scene_of(triangles);
    scene.shapes.push_back(make_shape(BoxShape{}, placed(0.5, {1, 2, 3})));
    scene.shapes.push_back(make_shape(SphereShape{0.25}, placed(2, {-1, 0, 1})));
    scene.shapes.push_back(make_shape(DiskShape{0.5}, placed(1, {-1, -0.5, 1})));
    for (ShapeDescription& shape : scene.shapes) {
        shape.transform = placed(scale, scale * translation) * shape.transform;
        shape.emission = Emission{Vec3(1, 2, 3), true};
    }
    scene.environment = EnvironmentDescription{Vec3(0.5), {}};
    scene.camera.position = scale * (Vec3(0.5, 1, 7) + translation);
    scene.camera.look_at = scale * (Vec3(0, 1, 0) + translation);
    return scene;
}

InlineTriangles one_triangle(const std::vector<Vec3>& normals = {})
{
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, normals, {{0, 1, 2}}};
}
} // namespace

TEST_CASE("moving a scene by a representable vector or scaling it by a power of two changes no bit")
{
    const Geometry plain = make_geometry(scene_of_everything(1.0, Vec3(0.0)));
    CHECK(plain.triangle_count == 32);
    for (const Vec3& by : {Vec3(1e5, -1e5, 1e5), Vec3(1e6, 0, 3), Vec3(1e7, 1e7, -1e7)})
        CHECK(same_bits(plain, make_geometry(scene_of_everything(1.0, by))));
    for (const int k : {-40, -20, -1, 1, 13, 40})
        CHECK(same_bits(plain, make_geometry(scene_of_everything(std::ldexp(1.0, k), Vec3(0.0)))));
    CHECK(same_bits(plain, make_geometry(scene_of_everything(std::ldexp(1.0, 20), Vec3(1e6, -2, 0)))));
    CHECK_FALSE(same_bits(plain, make_geometry(scene_of_everything(1.5, Vec3(0.0)))));
}

TEST_CASE("the largest half-extent falls into (1/2, 1] and the centre to the origin")
{
    for (const double size : {1.0, 2.0, 1.999, 2.001, 3.0, 1e-30, 1e30}) {
        INFO(size);
        const Geometry geometry =
            make_geometry(scene_of(BoxShape{{size, size / 2, size / 4}}, placed(1, Vec3(size, 0, 7 * size))));
        double half = 0.0;
        for (const Primitive& p : geometry.primitives)
            for (const real4& v : {p.a, p.b, p.c}) half = std::max(half, std::abs(static_cast<double>(v.s[0])));
        CHECK(half > 0.5);
        CHECK(half <= 1.0);
        CHECK(half == Approx(size / 2 * geometry.normalisation.scale).epsilon(1e-6));
        int exponent = 0;
        CHECK(std::frexp(geometry.normalisation.scale, &exponent) == 0.5);
        CHECK(static_cast<double>(geometry.bounding_sphere.s[3]) == Approx(half * std::sqrt(1.3125)).epsilon(1e-6));
        for (const Primitive& p : geometry.primitives)
            for (const real4& v : {p.a, p.b, p.c})
                REQUIRE(glm::length(vec3(v) - vec3(geometry.bounding_sphere)) <=
                        static_cast<double>(geometry.bounding_sphere.s[3]));
    }
}

TEST_CASE("primitives are triangles, spheres, disks, whatever the order of shapes, and know their material and light")
{
    Scene scene = scene_of(DiskShape{0.5});
    scene.materials.push_back(default_material(BSDF_DIELECTRIC));
    scene.materials.push_back(default_material(BSDF_MIRROR));
    scene.shapes.push_back(make_shape(SphereShape{0.5}, placed(1, {2, 0, 0})));
    scene.shapes.push_back(make_shape(RectangleShape{}, placed(1, {0, 0, -2})));
    scene.shapes[0].material = 1;
    scene.shapes[1].material = 2;
    scene.shapes[0].emission = Emission{Vec3(1), false};
    scene.shapes[2].emission = Emission{Vec3(2), false};
    scene.environment = EnvironmentDescription{Vec3(3), {}};
    const Geometry g = make_geometry(scene);
    CHECK(g.triangle_count == 2);
    CHECK(g.sphere_count == 1);
    CHECK(g.disk_count == 1);
    REQUIRE(g.primitives.size() == 4);
    REQUIRE(g.surfaces.size() == 4);
    const int kinds[] = {PRIMITIVE_TRIANGLE, PRIMITIVE_TRIANGLE, PRIMITIVE_SPHERE, PRIMITIVE_DISK};
    const uint materials[] = {0, 0, 2, 1}, lights[] = {0, 1, NO_INDEX, 2};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(g.primitives[i].a.s[3] == static_cast<float>(kinds[i]));
        CHECK(g.surfaces[i].material == materials[i]);
        CHECK(g.surfaces[i].light == lights[i]);
        CHECK(g.surfaces[i].normal == NO_INDEX);
        CHECK(g.surfaces[i].flags == 0);
    }
    REQUIRE(g.lights.size() == 4);
    CHECK(g.lights[0].primitive == 0);
    CHECK(g.lights[1].primitive == 1);
    CHECK(g.lights[2].primitive == 3);
    CHECK(g.lights[3].type == LIGHT_ENVIRONMENT);
    float sum = 0;
    for (const Light& light : g.lights) sum += light.radiance.s[3];
    CHECK(sum == Approx(1.0f));

    const double scale = g.normalisation.scale;
    CHECK(vec3(g.primitives[2].b) == Vec3(0.5 * scale, 0, 0));
    CHECK(vec3(g.primitives[3].b) == Vec3(0, 0, 1));
    CHECK(vec3(g.primitives[3].c) == Vec3(0.5 * scale, 0, 0));
    CHECK(vec3(g.primitives[3].a) == (Vec3(0) - g.normalisation.centre) * scale);

    REQUIRE(g.materials.size() == 3);
    CHECK(g.materials[0].flags == 0);
    CHECK(g.materials[1].flags == MATERIAL_DELTA);
    CHECK(g.materials[2].flags == MATERIAL_DELTA);
    CHECK(g.materials[2].type == BSDF_MIRROR);
    CHECK(g.materials[1].first_parameter == bsdf_parameter_count(BSDF_DIFFUSE));
    CHECK(g.parameters.size() == g.materials[2].first_parameter + bsdf_parameter_count(BSDF_MIRROR));
    for (std::size_t i = 0; i < bsdf_parameter_count(BSDF_DIELECTRIC); ++i)
        CHECK(g.parameters[g.materials[1].first_parameter + i] == static_cast<float>(scene.materials[1].parameters[i]));
}

TEST_CASE("lights of every shape are chosen by radiance times area")
{
    Scene scene = scene_of(RectangleShape{{2, 3}}, placed(1, {0, 5, 0}));
    scene.shapes.push_back(make_shape(SphereShape{0.5}, placed(2, {3, 0, 0})));
    scene.shapes.push_back(make_shape(DiskShape{1.5}));
    for (ShapeDescription& shape : scene.shapes) shape.emission = Emission{Vec3(7), false};
    const Geometry g = make_geometry(scene);
    REQUIRE(g.lights.size() == 4);
    const double pi = std::acos(-1.0);
    const double areas[] = {3.0, 3.0, 4 * pi, 2.25 * pi};
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(static_cast<double>(g.lights[i].radiance.s[3]) == Approx(0.9 * areas[i] / (6 + 6.25 * pi) + 0.025));
}

TEST_CASE("triangles face the side of their vertex normals, and flat ones keep none")
{
    const auto surface = [](const std::vector<Vec3>& normals, bool flip_normals, const Mat4& transform = Mat4(1.0)) {
        Scene scene = scene_of(one_triangle(normals), transform);
        scene.shapes[0].flip_normals = flip_normals;
        const Geometry g = make_geometry(scene);
        CHECK(g.normals.size() == (g.surfaces[0].normal == NO_INDEX ? 0 : 3));
        return g.surfaces[0];
    };
    const Vec3 z(0, 0, 1), oblique(0.6, 0, 0.8);
    CHECK(surface({}, false).flags == 0);
    CHECK(surface({}, true).flags == SURFACE_FLIP_NORMAL);
    CHECK(surface({z, z, z}, false).flags == 0);
    CHECK(surface({z, z, z}, false).normal == NO_INDEX);
    CHECK(surface({-z, -z, -z}, false).flags == SURFACE_FLIP_NORMAL);
    CHECK(surface({-z, -z, -z}, false).normal == NO_INDEX);
    CHECK(surface({-z, -z, -z}, true).flags == 0);
    CHECK(surface({z, oblique, z}, false).normal == 0);
    CHECK(surface({z, oblique, -z}, false).flags == 0);
    CHECK(surface({-z, -oblique, -z}, false).flags == SURFACE_FLIP_NORMAL);
    // A mirror changes what is left and right, not what is in front.
    Mat4 mirror(1.0);
    mirror[0][0] = -1;
    CHECK(surface({z, z, z}, false, mirror).flags == 0);
    CHECK(surface({}, false, mirror).flags == 0);
    CHECK(surface({-z, -z, -z}, false, mirror).flags == SURFACE_FLIP_NORMAL);
}

TEST_CASE("vertex normals go with the inverse transpose, and round with flip_normals")
{
    Mat4 stretch(1.0);
    stretch[0][0] = 4;
    Scene scene = scene_of(one_triangle({{0, 0, 1}, {3, 0, 4}, {0, 0, 9}}), stretch);
    const Geometry g = make_geometry(scene);
    REQUIRE(g.normals.size() == 3);
    CHECK(vec3(g.normals[0]) == Vec3(0, 0, 1));
    CHECK(glm::length(vec3(g.normals[1]) - glm::normalize(Vec3(0.75, 0, 4))) <= 1e-7);
    scene.shapes[0].flip_normals = true;
    const Geometry flipped = make_geometry(scene);
    for (std::size_t i = 0; i < 3; ++i) CHECK(vec3(flipped.normals[i]) == -vec3(g.normals[i]));
}

TEST_CASE("vertex normals without a direction give way to the triangle's, with one warning")
{
    const Geometry g = make_geometry(scene_of(one_triangle({{0, 0, 0}, {-0.6, 0, -0.8}, {0, NAN, 0}})));
    REQUIRE(g.normals.size() == 3);
    CHECK(vec3(g.normals[0]) == Vec3(0, 0, -1));
    CHECK(vec3(g.normals[2]) == Vec3(0, 0, -1));
    CHECK(g.surfaces[0].flags == SURFACE_FLIP_NORMAL);
    CHECK(g.warnings ==
          std::vector<std::string>{"shape \"s\": 2 vertex normals have no direction; those of the triangles "
                                   "take their place."});
}

TEST_CASE("a lenient render equals that of the scene without the triangles that were dropped")
{
    InlineTriangles triangles = one_triangle({{0, 0, 1}, {0.6, 0, 0.8}, {0, 0, 1}});
    const Geometry clean = make_geometry(scene_of(triangles));
    // Without area, far away; not finite; without area only after rounding.
    triangles.positions.insert(triangles.positions.end(),
                               {{50, 0, 0}, {100, 0, 0}, {NAN, 0, 0}, {3, 3, 1 + 1e-12}, {3, 3, 1}});
    triangles.normals.resize(8, Vec3(0, 0, 1));
    triangles.indices = {{0, 3, 4}, {0, 1, 5}, {0, 1, 2}, {0, 6, 7}};
    const Geometry lenient = make_geometry(scene_of(triangles), {true});
    CHECK(same_bits(clean, lenient));
    CHECK(lenient.statistics.dropped_triangles == 3);
    CHECK(lenient.warnings ==
          std::vector<std::string>{"3 triangles without area or with corners that are not finite were dropped."});
    CHECK_THROWS_WITH(make_geometry(scene_of(triangles)),
                      "/shapes/0: triangle 1 of shape \"s\" has a corner that is not "
                      "finite; --lenient drops such triangles.");
}

TEST_CASE("the course box comes from its files: 34 triangles that face their vertex normals and keep none of them")
{
    Scene scene;
    scene.folder = ETENDUE_SOURCE_DIR "/scenes/course-box";
    scene.materials.push_back(default_material(BSDF_DIFFUSE));
    for (const char* name : {"left", "right", "floor", "ceiling", "back", "short_box", "tall_box"})
        scene.shapes.push_back(make_shape(MeshFile{std::string("meshes/") + name + ".obj"}));
    const Geometry g = make_geometry(scene);
    CHECK(g.triangle_count == 34);
    CHECK(g.normals.empty());
    for (const PrimitiveSurface& surface : g.surfaces) CHECK(surface.flags == 0);
    CHECK(g.normalisation.centre == Vec3(0, 1, 0));
    CHECK(g.normalisation.scale == 1.0);
    CHECK(g.statistics.mesh_bytes > 1000);
    CHECK(g.statistics.mesh_seconds > 0.0);
    CHECK(g.warnings.empty());

    scene.shapes.push_back(make_shape(MeshFile{"meshes/none.obj"}));
    CHECK_THROWS_AS(make_geometry(scene), FileError);
    CHECK_THROWS_WITH(make_geometry(scene),
                      Catch::Contains("/scenes/course-box/meshes/none.obj: there is no such file."));
}

TEST_CASE("a scene of environment alone is seen from the origin")
{
    Scene scene;
    scene.environment.emplace().radiance = Vec3(1);
    const Geometry g = make_geometry(scene);
    CHECK(g.primitives.empty());
    CHECK(g.normalisation.centre == scene.camera.position);
    CHECK(g.normalisation.scale == 1.0);
    CHECK(vec3(g.camera.position) == Vec3(0.0));
    CHECK(g.bounding_sphere.s[3] == 0.0f);
    REQUIRE(g.lights.size() == 1);
    CHECK(g.lights[0].radiance.s[3] == 1.0f);
}

TEST_CASE("scenes that cannot be normalised or hold nothing are refused")
{
    Scene empty;
    empty.file = "s.json";
    CHECK_THROWS_WITH(make_geometry(empty),
                      "s.json: the scene has no geometry and no environment: there is nothing to render.");
    CHECK_THROWS_AS(make_geometry(empty), SceneError);
    InlineTriangles huge = one_triangle({});
    huge.positions[1].x = 1.5e308;
    huge.positions[2].x = -1.5e308;
    Scene huge_scene = scene_of(huge);
    huge_scene.file = "s.json";
    CHECK_THROWS_WITH(make_geometry(huge_scene),
                      "s.json: the geometry has an extent of inf, which cannot be rendered.");
    CHECK_THROWS_WITH(make_geometry(scene_of(BoxShape{Vec3(1e300)}, placed(1e10, Vec3(0)))),
                      Catch::Contains("triangle 0 of shape \"s\" has a corner that is not finite"));
    Scene scene = scene_of(BoxShape{});
    scene.shapes.push_back(make_shape(SphereShape{1e-40}));
    CHECK_THROWS_WITH(make_geometry(scene), "/shapes/0: a radius of 1e-40 is too small beside the rest of the scene.");
    scene.shapes.pop_back();
    scene.materials[0].parameters[0] = 1e39;
    scene.materials[0].location.pointer = "/materials/0";
    CHECK_THROWS_WITH(make_geometry(scene), "/materials/0: a parameter is 1e+39, which is no finite float.");
}
