#include "scene/scene_loader.h"

using namespace etendue;

namespace
{
Scene parse(const std::string& text)
{
    return parse_scene(text, "test.json").scene;
}
} // namespace

TEST_CASE("what a file leaves out is what scene.h says", "[host]")
{
    const Scene scene = parse(R"({"environment": {"radiance": 1}})");
    const CameraDescription camera;
    CHECK(scene.camera.position == camera.position);
    CHECK(scene.camera.look_at == camera.look_at);
    CHECK(scene.camera.up == camera.up);
    CHECK(scene.camera.vertical_fov == camera.vertical_fov);
    CHECK(scene.camera.focal_length == camera.focal_length);
    const FilmDescription film;
    CHECK(scene.film.width == film.width);
    CHECK(scene.film.height == film.height);
    CHECK(scene.film.filter == film.filter);
    CHECK(scene.film.filter_radius == film.filter_radius);
    CHECK(scene.film.filter_sigma == film.filter_sigma);
    CHECK(scene.film.tone_map == film.tone_map);
    CHECK(scene.film.exposure == film.exposure);
    const IntegratorDescription integrator;
    CHECK(scene.integrator.type == integrator.type);
    CHECK(scene.integrator.max_depth == integrator.max_depth);
    CHECK(scene.integrator.roulette == integrator.roulette);
    CHECK(scene.integrator.roulette_probability == integrator.roulette_probability);
    CHECK(scene.integrator.roulette_start == integrator.roulette_start);
    // But for the sampler: Scene's own one has samples whose variance is known, a file's has less noise.
    const SamplerDescription sampler;
    CHECK(scene.sampler.type == SamplerType::sobol);
    CHECK(scene.sampler.samples_per_pixel == sampler.samples_per_pixel);
    CHECK(scene.sampler.seed == sampler.seed);
    CHECK(scene.sampler.replicates == sampler.replicates);
    CHECK_FALSE(scene.accelerator.type.has_value());
    CHECK(scene.accelerator.build == BuildPlace::automatic);
    CHECK_FALSE(scene.course_format);
}

TEST_CASE("every key of camera, film, integrator, sampler, accelerator and environment is read", "[host]")
{
    const Scene scene = parse(R"({
        "camera": {"type": "pinhole", "position": [1, 2, 3], "look_at": [4, 5, 6], "up": [0, 0, 1], "vertical_fov": 33,
                   "focal_length": 2},
        "film": {"size": [320, 200], "filter": {"type": "gaussian", "radius": 1.5, "sigma": 0.4}, "tone_map": "gamma22",
                 "exposure": -1.5},
        "integrator": {"type": "light", "max_depth": "unlimited",
                       "roulette": {"type": "constant", "probability": 0.7, "start": 5}},
        "sampler": {"type": "stratified", "spp": 17, "seed": 18446744073709551615},
        "accelerator": {"type": "lbvh", "build": "host"},
        "environment": {"radiance": [1, 2, 3]}})");
    CHECK(scene.camera.position == Vec3(1, 2, 3));
    CHECK(scene.camera.look_at == Vec3(4, 5, 6));
    CHECK(scene.camera.up == Vec3(0, 0, 1));
    CHECK(scene.camera.vertical_fov == 33);
    CHECK(scene.camera.focal_length == 2);
    CHECK(scene.film.width == 320);
    CHECK(scene.film.height == 200);
    CHECK(scene.film.filter == FilterType::gaussian);
    CHECK(scene.film.filter_radius == 1.5);
    CHECK(scene.film.filter_sigma == 0.4);
    CHECK(scene.film.tone_map == ToneMap::gamma22);
    CHECK(scene.film.exposure == -1.5);
    CHECK(scene.integrator.type == IntegratorType::light);
    CHECK_FALSE(scene.integrator.max_depth.has_value());
    CHECK(scene.integrator.roulette == RouletteType::constant);
    CHECK(scene.integrator.roulette_probability == 0.7);
    CHECK(scene.integrator.roulette_start == 5);
    CHECK(scene.sampler.samples_per_pixel == 17);
    CHECK(scene.sampler.seed == 18446744073709551615u);
    CHECK(scene.sampler.type == SamplerType::stratified);
    CHECK(scene.accelerator.type == ACCELERATOR_LBVH);
    CHECK(scene.accelerator.build == BuildPlace::host);
    CHECK(scene.environment->radiance == Vec3(1, 2, 3));
}

TEST_CASE("a Sobol sampler has one or two replicates", "[host]")
{
    const auto sampler = [](const std::string& text) {
        return parse(R"({"environment": {"radiance": 1}, "sampler": )" + text + "}").sampler;
    };
    CHECK(sampler(R"("sobol")").type == SamplerType::sobol);
    CHECK(sampler(R"("sobol")").replicates == 2);
    CHECK(sampler(R"({"type": "sobol", "replicates": 1})").replicates == 1);
    CHECK(sampler(R"("independent")").type == SamplerType::independent);
    CHECK_THROWS_WITH(sampler(R"({"type": "sobol", "replicates": 3})"), Catch::Contains("between 1 and 2, is 3"));
    CHECK_THROWS_WITH(sampler(R"({"type": "independent", "replicates": 1})"), Catch::Contains("replicates"));
}

TEST_CASE("names alone stand for filters, integrators, roulettes and accelerators", "[host]")
{
    const auto with = [](const std::string& key) { return parse("{\"environment\": {\"radiance\": 1}, " + key + "}"); };
    CHECK(with(R"("film": {"filter": "tent"})").film.filter == FilterType::tent);
    CHECK(with(R"("film": {"filter": "tent"})").film.filter_radius == 1.0);
    CHECK(with(R"("film": {"filter": "gaussian"})").film.filter_radius == 2.0);
    CHECK(with(R"("integrator": "normals")").integrator.type == IntegratorType::normals);
    CHECK(with(R"("integrator": "hemisphere")").integrator.type == IntegratorType::hemisphere);
    CHECK(with(R"("integrator": "bsdf")").integrator.type == IntegratorType::bsdf);
    CHECK(with(R"("integrator": {"roulette": "off"})").integrator.roulette == RouletteType::off);
    CHECK(with(R"("accelerator": "none")").accelerator.type == ACCELERATOR_BRUTE_FORCE);
    CHECK(with(R"("accelerator": {"build": "device"})").accelerator.build == BuildPlace::device);
}
