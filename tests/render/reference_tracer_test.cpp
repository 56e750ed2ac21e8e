// The reference tracer is the truth of other tests, so its own truth is exact values, closed forms, and the course box
// as another renderer sees it.
#include "scene/scene_loader.h"
#include "support/form_factors.h"
#include "support/reference_tracer.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

using namespace etendue;

namespace
{
std::uint32_t add_material(Scene& scene, BsdfType bsdf, std::vector<double> parameters)
{
    scene.materials.push_back({"material", bsdf, std::move(parameters), {}});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

ShapeDescription& add_shape(Scene& scene, decltype(ShapeDescription::geometry) geometry, std::uint32_t material)
{
    ShapeDescription& shape = scene.shapes.emplace_back();
    shape.geometry = std::move(geometry);
    shape.material = material;
    return shape;
}

// Turns +z, the normal of rectangles and disks, to +y or -y, then moves.
Mat4 facing_up(const Vec3& place = Vec3(0.0))
{
    return glm::rotate(glm::translate(Mat4(1.0), place), -glm::half_pi<double>(), Vec3(1, 0, 0));
}
Mat4 facing_down(const Vec3& place)
{
    return glm::rotate(glm::translate(Mat4(1.0), place), glm::half_pi<double>(), Vec3(1, 0, 0));
}

// One pixel that is one ray.
void look(Scene& scene, const Vec3& from, const Vec3& at)
{
    scene.camera.position = from;
    scene.camera.look_at = at;
    scene.camera.vertical_fov = 1e-7;
    scene.film.width = scene.film.height = 1;
}

Scene furnace(decltype(ShapeDescription::geometry) geometry, const Vec3& albedo, std::optional<std::uint32_t> max_depth)
{
    Scene scene;
    ShapeDescription& shape =
        add_shape(scene, std::move(geometry), add_material(scene, BSDF_DIFFUSE, {albedo.x, albedo.y, albedo.z}));
    shape.flip_normals = true; // emits inwards
    shape.emission = Emission{Vec3(1.0), false};
    scene.camera.position = {0.1, 0.2, -0.3};
    scene.camera.vertical_fov = 90;
    scene.film.width = scene.film.height = 8;
    scene.integrator.max_depth = max_depth;
    return scene;
}

// Within 4 standard errors, which are below `error` of the expected value. Rounding may be all the error there is.
void check_mean(const ReferencePicture& picture, const Vec3& expected, double error)
{
    for (int i = 0; i < 3; ++i) {
        CAPTURE(i, expected[i], picture.mean[i], picture.standard_error[i]);
        CHECK(picture.standard_error[i] < error * expected[i]);
        CHECK(std::abs(picture.mean[i] - expected[i]) < 4.0 * picture.standard_error[i] + 1e-12 * expected[i]);
    }
}

// A white-hot light of radiance 3 above the floor point at the origin, seen by one ray.
Scene lit_floor(const ShapeDescription& light)
{
    Scene scene;
    const std::uint32_t grey = add_material(scene, BSDF_DIFFUSE, {0.6, 0.4, 0.2});
    const std::uint32_t black = add_material(scene, BSDF_DIFFUSE, {0, 0, 0});
    add_shape(scene, RectangleShape{Vec2(10.0)}, grey).transform = facing_up();
    scene.shapes.push_back(light);
    scene.shapes.back().material = black;
    scene.shapes.back().emission = Emission{Vec3(3.0), false};
    look(scene, {3, 0.2, 0}, {0, 0, 0});
    scene.integrator.max_depth = 1;
    return scene;
}

void check_lit_floor(const ShapeDescription& light, double form_factor)
{
    const Scene scene = lit_floor(light);
    ReferenceOptions options;
    for (const bool sample_lights : {true, false}) {
        options.sample_lights = sample_lights;
        options.samples_per_batch = 20000;
        check_mean(render_reference(scene, options), 3.0 * form_factor * Vec3(0.6, 0.4, 0.2), 6e-3);
    }
}
} // namespace

TEST_CASE("the reference finds the exact radiance of every depth in a box and in a sphere that glow", "[host]")
{
    const std::uint32_t depth = GENERATE(0u, 1u, 2u, 8u, 1000u);
    const bool sphere = GENERATE(false, true);
    const Vec3 albedo(0.8, 0.5, 0.999);
    const Scene scene = sphere ? furnace(SphereShape{1.0}, albedo, depth) : furnace(BoxShape{Vec3(2.0)}, albedo, depth);
    ReferenceOptions options;
    options.sample_lights = false;
    options.roulette_start = 100000;
    options.batches = 2;
    const Vec3 expected = (1.0 - pow(albedo, Vec3(depth + 1.0))) / (1.0 - albedo);
    for (const Vec3& pixel : render_reference(scene, options).pixels)
        for (int i = 0; i < 3; ++i) CHECK(pixel[i] == Approx(expected[i]).epsilon(1e-12));
}

TEST_CASE("light sampled from inside a sphere that glows has no variance in the reference", "[host]")
{
    Scene scene = furnace(SphereShape{0.5}, {0.8, 0.5, 0.2}, 3);
    scene.shapes[0].transform = glm::scale(glm::translate(Mat4(1.0), Vec3(7, 0, 0)), Vec3(4.0));
    scene.camera.position.x += 7;
    scene.camera.look_at = {7, 0, 0};
    ReferenceOptions options;
    options.batches = 2;
    options.roulette_start = 100;
    for (const Vec3& pixel : render_reference(scene, options).pixels)
        CHECK(pixel.x == Approx(1 + 0.8 + 0.8 * 0.8 + 0.8 * 0.8 * 0.8).epsilon(1e-6));
}

TEST_CASE("roulette keeps the mean of the reference", "[host]")
{
    ReferenceOptions options;
    options.sample_lights = false;
    options.roulette_start = GENERATE(0u, 4u);
    options.samples_per_batch = 20;
    check_mean(render_reference(furnace(BoxShape{Vec3(2.0)}, {0.98, 0.5, 0.2}, std::nullopt), options), {50, 2, 1.25},
               0.01);
}

TEST_CASE("a floor under a rectangle, a disk and a sphere is lit by the form factor in the reference", "[host]")
{
    ShapeDescription light;
    SECTION("rectangle")
    {
        light.geometry = RectangleShape{Vec2(0.7, 1.3)};
        light.transform = facing_down({0.35, 0.9, 0.65});
        check_lit_floor(light, parallel_rectangle_form_factor(0.7, 1.3, 0.9));
    }
    SECTION("disk")
    {
        light.geometry = DiskShape{0.3};
        light.transform = glm::scale(facing_down({0.0, 0.8, 0.9}), Vec3(2.0));
        check_lit_floor(light, disk_form_factor(0.6, 0.8, 0.9));
    }
    SECTION("sphere across the horizon")
    {
        light.geometry = SphereShape{1.0};
        light.transform[3] = Vec4(0, 1.6 * std::cos(1.2), 1.6 * std::sin(1.2), 1);
        check_lit_floor(light, sphere_form_factor(1.0, 1.6, 1.2));
    }
}

TEST_CASE("a one-sided light seen from behind is black in the reference and a two-sided one is not", "[host]")
{
    ShapeDescription light;
    light.geometry = RectangleShape{Vec2(1.0)};
    light.transform = facing_up({0, 1, 0});
    Scene scene = lit_floor(light);
    ReferenceOptions options;
    options.sample_lights = GENERATE(true, false);
    CHECK(render_reference(scene, options).mean == Vec3(0.0));
    scene.shapes[1].emission->two_sided = true;
    options.samples_per_batch = 20000;
    check_mean(render_reference(scene, options), 3.0 * 0.2394564705 * Vec3(0.6, 0.4, 0.2), 5e-3);
}

TEST_CASE("a mirrored transform leaves the outside of a box outside in the reference", "[host]")
{
    Scene scene = furnace(BoxShape{Vec3(2.0)}, Vec3(0.5), 0);
    scene.shapes[0].transform = glm::scale(Mat4(1.0), Vec3(-1, 1, 1));
    for (const Vec3& pixel : render_reference(scene).pixels) CHECK(pixel == Vec3(1.0));
}

TEST_CASE("a convex body under a uniform sky has the colour of its albedo in the reference", "[host]")
{
    Scene scene;
    add_shape(scene, BoxShape{Vec3(0.8)}, add_material(scene, BSDF_DIFFUSE, {0.8, 0.5, 0.25}));
    scene.environment = EnvironmentDescription{Vec3(1.0), {}};
    scene.integrator.max_depth = 1;
    look(scene, {3, 2, 1}, {0, 0, 0});
    CHECK(length(render_reference(scene).mean - Vec3(0.8, 0.5, 0.25)) < 1e-12);
    look(scene, {3, 2, 1}, {0, 2, 0});
    CHECK(render_reference(scene).mean == Vec3(1.0));
}

TEST_CASE("a light met after a mirror counts once in the reference", "[host]")
{
    Scene scene;
    add_shape(scene, RectangleShape{Vec2(10.0)}, add_material(scene, BSDF_MIRROR, {0.9, 0.8, 0.7})).transform =
        facing_up();
    ShapeDescription& light = add_shape(scene, RectangleShape{Vec2(1.0)}, add_material(scene, BSDF_DIFFUSE, {0, 0, 0}));
    light.transform = facing_down({-3, 2, 0});
    light.emission = Emission{Vec3(2.0), false};
    look(scene, {3, 2, 0}, {0, 0, 0});
    scene.integrator.max_depth = GENERATE(0u, 1u, 5u);
    const Vec3 expected = scene.integrator.max_depth == 0u ? Vec3(0.0) : Vec3(1.8, 1.6, 1.4);
    CHECK(length(render_reference(scene).mean - expected) < 1e-12);
}

TEST_CASE("glass under a uniform sky is invisible in the reference", "[host]")
{
    Scene scene;
    const double ior = GENERATE(1.0, 1.5, 1.0 / 1.5, 2.4);
    const std::uint32_t glass = add_material(scene, BSDF_DIELECTRIC, {ior, 1, 1, 1});
    add_shape(scene, SphereShape{1.0}, glass);
    add_shape(scene, BoxShape{Vec3(0.5)}, glass).transform = glm::rotate(Mat4(1.0), 0.4, glm::normalize(Vec3(1, 2, 3)));
    scene.environment = EnvironmentDescription{Vec3(1.0), {}};
    scene.film.width = scene.film.height = 16;
    scene.integrator.max_depth = 1000000;
    ReferenceOptions options;
    options.batches = 2;
    options.roulette_start = 1000000;
    for (const Vec3& pixel : render_reference(scene, options).pixels) CHECK(pixel.x == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("glass of index 1.5 transmits what Fresnel's law says in the reference", "[host]")
{
    Scene scene;
    const std::uint32_t glass = add_material(scene, BSDF_DIELECTRIC, {1.5, 1, 0.5, 1});
    add_shape(scene, BoxShape{{4, 4, 1}}, glass);
    ShapeDescription& light = add_shape(scene, DiskShape{1.0}, add_material(scene, BSDF_DIFFUSE, {0, 0, 0}));
    light.emission = Emission{Vec3(1.0), false};
    look(scene, {0, 0, 5}, {0, 0, 0});
    ReferenceOptions options;
    options.samples_per_batch = 20000;
    SECTION("a slab in front of the light, with every reflection inside it")
    {
        scene.integrator.max_depth.reset();
        light.transform[3].z = -2;
        // The tint counts at each surface: t^2 / (1 - r^2) with t = 0.96 tint and r = 0.04 tint.
        check_mean(render_reference(scene, options), {12.0 / 13.0, 0.48 * 0.48 / (1 - 0.02 * 0.02), 12.0 / 13.0}, 1e-3);
    }
    SECTION("a light inside it, whose radiance is denser by the square of the index")
    {
        scene.integrator.max_depth = 1;
        check_mean(render_reference(scene, options), Vec3(0.96, 0.48, 0.96) / 2.25, 1e-3);
    }
}

TEST_CASE("the reference agrees with another renderer on the course box", "[host]")
{
    Scene scene = load_scene(ETENDUE_SOURCE_DIR "/scenes/course-box/simple.json").scene;
    scene.film.width = scene.film.height = 64;
    ReferenceOptions options;
    options.samples_per_batch = 4;
    scene.integrator.max_depth.reset();
    const ReferencePicture picture = render_reference(scene, options);
    // Mitsuba 3.9.1, 28672 samples per pixel of 256x256, no limit of depth; standard error 2e-6.
    check_mean(picture, {0.2795071, 0.1733809, 0.0627627}, 3e-3);
    // The seed decides every bit, and the pixels average to the mean.
    scene.film.width = scene.film.height = 8;
    const ReferencePicture small = render_reference(scene, options);
    CHECK(small.pixels == render_reference(scene, options).pixels);
    Vec3 sum(0.0);
    for (const Vec3& pixel : small.pixels) sum += pixel;
    CHECK(length(sum / 64.0 - small.mean) < 1e-12);
    options.seed = 2;
    CHECK(small.pixels != render_reference(scene, options).pixels);
}
