// What reaches the kernels of what a scene says.
#include "render/render_settings.h"
#include "scene/scene_loader.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

using namespace etendue;

namespace
{
const char* const SCENE = R"({
    "camera": {"position": [0, 1, 5], "look_at": [0, 1, 0]},
    "film": {"size": [30, 20]},
    "materials": [{"name": "grey", "type": "diffuse", "albedo": 0.5}],
    "shapes": [{"type": "rectangle", "size": [2, 2], "material": "grey"},
               {"type": "sphere", "radius": 0.5, "material": "grey", "transform": {"translate": [0, 0, 1]}}],
    "lights": [{"type": "sphere", "radius": 0.1, "radiance": 1, "transform": {"translate": [0, 2, 1]}}]
})";

struct Made {
    Scene scene;
    Geometry geometry;
    RenderSettings settings;
};

Made make(const std::vector<std::string>& overrides)
{
    Made made;
    made.scene = parse_scene(SCENE, "settings.json", overrides).scene;
    made.geometry = make_geometry(made.scene);
    made.settings = make_render_settings(made.scene, made.geometry, ACCELERATOR_LBVH);
    return made;
}

RenderSettings settings_of(const std::vector<std::string>& overrides)
{
    return make(overrides).settings;
}

// The part of a round Gaussian of standard deviation sigma within a radius: the integral of r / sigma^2 exp(-r^2 / (2
// sigma^2)), by the midpoint rule.
double part_within(double radius, double sigma)
{
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double r = radius * (i + 0.5) / steps;
        sum += r / (sigma * sigma) * std::exp(-r * r / (2 * sigma * sigma)) * radius / steps;
    }
    return sum;
}
} // namespace

TEST_CASE("numbers of the scene and its geometry are in the settings")
{
    const Made made = make({"sampler.seed=81985529216486895", "integrator.max_depth=5"});
    const RenderSettings& s = made.settings;
    CHECK(s.width == 30);
    CHECK(s.height == 20);
    CHECK(s.seed_high == 0x01234567u);
    CHECK(s.seed_low == 0x89abcdefu);
    CHECK(s.max_depth == 5);
    CHECK(s.accelerator == ACCELERATOR_LBVH);
    CHECK(s.primitive_count == 4);
    CHECK(s.light_count == 1);
    CHECK(s.environment_light == NO_INDEX);
    CHECK(std::memcmp(&s.camera, &made.geometry.camera, sizeof(Camera)) == 0);
    CHECK(s.scene_bounds.s[3] == made.geometry.bounding_sphere.s[3]);
    CHECK(s.scene_bounds.s[3] > 0.0f);
}

TEST_CASE("the sampler is a number, and decides what tells the error of a picture")
{
    struct Choice {
        const char* sampler;
        uint number, replicates;
        ErrorEstimate estimate;
    };
    for (const Choice& choice :
         {Choice{R"("independent")", SAMPLER_INDEPENDENT, 2, ErrorEstimate::samples},
          Choice{R"("stratified")", SAMPLER_STRATIFIED, 2, ErrorEstimate::blocks},
          Choice{R"("sobol")", SAMPLER_SOBOL, 2, ErrorEstimate::halves},
          Choice{R"({"type": "sobol", "replicates": 2})", SAMPLER_SOBOL, 2, ErrorEstimate::halves},
          Choice{R"({"type": "sobol", "replicates": 1})", SAMPLER_SOBOL, 1, ErrorEstimate::none}}) {
        INFO(choice.sampler);
        const Made made = make({std::string("sampler=") + choice.sampler});
        CHECK(made.settings.sampler == choice.number);
        CHECK(made.settings.replicates == choice.replicates);
        CHECK(error_estimate_of(made.scene) == choice.estimate);
    }
}

TEST_CASE("an unlimited depth is the largest number")
{
    CHECK(settings_of({"integrator.max_depth=\"unlimited\""}).max_depth == NO_INDEX);
    CHECK(settings_of({"integrator.max_depth=0"}).max_depth == 0);
}

TEST_CASE("each integrator is a choice of light sampling, emission and directions")
{
    struct Choice {
        const char* integrator;
        uint sample_lights, count_emission, uniform_hemisphere;
    };
    for (const Choice& choice : {Choice{"hemisphere", 0, 1, 1}, Choice{"bsdf", 0, 1, 0}, Choice{"light", 1, 0, 0},
                                 Choice{"path", 1, 1, 0}, Choice{"normals", 0, 1, 0}}) {
        INFO(choice.integrator);
        const RenderSettings s = settings_of({std::string("integrator.type=\"") + choice.integrator + '"'});
        CHECK(s.sample_lights == choice.sample_lights);
        CHECK(s.count_emission == choice.count_emission);
        CHECK(s.uniform_hemisphere == choice.uniform_hemisphere);
    }
}

TEST_CASE("how lights are found is a choice of the integrators that sample them")
{
    const auto with = [](const char* integrator) {
        return settings_of({std::string("integrator.type=\"") + integrator + '"', "integrator.heuristic=\"balance\"",
                            "integrator.sphere_lights=\"area\""});
    };
    CHECK(settings_of({}).balance_heuristic == 0);
    CHECK(settings_of({}).sphere_area == 0);
    CHECK(with("path").balance_heuristic == 1);
    CHECK(with("path").sphere_area == 1);
    CHECK(with("light").balance_heuristic == 0); // nothing to weigh
    CHECK(with("light").sphere_area == 1);
    CHECK(with("bsdf").balance_heuristic == 0);
    CHECK(with("bsdf").sphere_area == 0);
}

TEST_CASE("without a light none is sampled")
{
    const RenderSettings s = settings_of({"lights=[]"});
    CHECK(s.sample_lights == 0);
    CHECK(s.light_count == 0);
    CHECK(s.alias_shift == 32);
}

TEST_CASE("the alias shift and the environment's index follow the lights")
{
    const auto with_lights = [](int extra, bool environment) {
        std::vector<std::string> overrides;
        std::string lights;
        for (int i = 0; i <= extra; ++i)
            lights += std::string(i ? "," : "") +
                      R"({"type":"sphere","radius":0.1,"radiance":1,"transform":{"translate":[0,2,)" +
                      std::to_string(i) + "]}}";
        overrides.push_back("lights=[" + lights + "]");
        if (environment) overrides.push_back(R"(environment={"radiance":1})");
        return make(overrides);
    };
    for (const int lights : {1, 2, 3, 5})
        for (const bool environment : {false, true}) {
            const Made made = with_lights(lights - 1, environment);
            const std::size_t buckets = made.geometry.light_table.size();
            INFO(lights << " lights, " << buckets << " buckets");
            REQUIRE(buckets >= made.geometry.lights.size());
            CHECK((std::uint64_t{1} << (32 - made.settings.alias_shift)) == buckets);
            CHECK(made.settings.environment_light == (environment ? static_cast<uint>(lights) : NO_INDEX));
        }
}

TEST_CASE("the filter's numbers are its radius, its width and the part of a Gaussian within")
{
    CHECK(settings_of({}).filter == FILTER_BOX);
    const RenderSettings tent = settings_of({R"(film.filter={"type":"tent","radius":1.5})"});
    CHECK(tent.filter == FILTER_TENT);
    CHECK(tent.filter_parameters.s[0] == 1.5f);
    const RenderSettings gaussian = settings_of({R"(film.filter={"type":"gaussian","radius":1.25,"sigma":0.75})"});
    CHECK(gaussian.filter == FILTER_GAUSSIAN);
    CHECK(gaussian.filter_parameters.s[0] == 1.25f);
    CHECK(gaussian.filter_parameters.s[1] == 0.75f);
    CHECK(static_cast<double>(gaussian.filter_parameters.s[2]) == Approx(part_within(1.25, 0.75)).epsilon(1e-6));
}

TEST_CASE("roulette is off, constant or by throughput")
{
    CHECK(settings_of({"integrator.roulette=\"off\""}).roulette == ROULETTE_OFF);
    const RenderSettings constant =
        settings_of({R"(integrator.roulette={"type":"constant","probability":0.75,"start":2})"});
    CHECK(constant.roulette == ROULETTE_CONSTANT);
    CHECK(constant.roulette_parameters.s[0] == 0.75f);
    CHECK(constant.roulette_start == 2);
    CHECK(settings_of({"integrator.roulette=\"throughput\""}).roulette == ROULETTE_THROUGHPUT);
}

TEST_CASE("a named accelerator is taken; else small scenes get none and large ones a tree")
{
    AcceleratorDescription wanted;
    for (const std::uint32_t lanes : {1u, 16u}) {
        CHECK(choose_accelerator(wanted, 0, lanes) == ACCELERATOR_BRUTE_FORCE);
        CHECK(choose_accelerator(wanted, 1, lanes) == ACCELERATOR_BRUTE_FORCE);
        CHECK(choose_accelerator(wanted, 100000, lanes) == ACCELERATOR_LBVH);
    }
    // Testing one primitive against all lanes at once pays for longer.
    CHECK(choose_accelerator(wanted, 12, 16) == ACCELERATOR_BRUTE_FORCE);
    CHECK(choose_accelerator(wanted, 12, 1) == ACCELERATOR_LBVH);
    wanted.type = ACCELERATOR_LBVH;
    CHECK(choose_accelerator(wanted, 1, 16) == ACCELERATOR_LBVH);
    wanted.type = ACCELERATOR_BRUTE_FORCE;
    CHECK(choose_accelerator(wanted, 100000, 16) == ACCELERATOR_BRUTE_FORCE);
}

TEST_CASE("the normals integrator takes one sample, the others those of the scene")
{
    CHECK(wanted_samples(make({"sampler.spp=77"}).scene) == 77);
    CHECK(wanted_samples(make({"sampler.spp=77", "integrator.type=\"normals\""}).scene) == 1);
}
