// The stages of a path one by one: beginning, accidents, weights, roulette, the end.
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace etendue
{
namespace
{
const char* DEFINITIONS = R"(
/* A path at its first vertex in every lane. */
STATIC PathState new_path(void)
{
    PathState path;
    path.active = to_mask(true);
    path.ray.origin = black();
    path.ray.direction = vec3((Float)(0.0), (Float)(0.0), (Float)(-1.0));
    path.ray.t_max = (Float)(INFINITE);
    path.ray.from = path.ray.to = (Uint)(NO_INDEX);
    path.throughput = white();
    path.radiance = black();
    path.pdf = path.radiance_scale = (Float)(1.0);
    path.delta = to_mask(false);
    path.vertices = path.accident = (Uint)(0u);
    path.stream.key_low = path.stream.key_high = path.stream.sample_high = 0u;
    path.stream.pixel = path.stream.sample = (Uint)(0u);
    path.stream.sampler = SAMPLER_INDEPENDENT;
    path.stream.replicates = 1u;
    return path;
}

STATIC SceneView view_of(global const RenderSettings* settings)
{
    SceneView view;
    view.settings = settings;
    return view;
}
)";

const DeviceFunctions functions(
    {"integrator/path.h"},
    {{"begin", "RenderSettings* mask uint uint -> mask float float uint uint uint mask float",
      "PathState path = new_path();\n"
      "path.active = to_mask(false);\n"
      "path.throughput = scale3(white(), (Float)(0.5)); path.vertices = (Uint)(7u); path.accident = (Uint)(9u);\n"
      "path.ray.from = (Uint)(5u); path.radiance_scale = (Float)(0.25);\n"
      "path_begin(view_of(in0), &path, in1, in2, in3);\n"
      "out0 = path.active; out1 = path.throughput.x; out2 = path.ray.direction.z; out3 = path.vertices;\n"
      "out4 = path.accident; out5 = path.ray.from; out6 = path.delta; out7 = path.radiance_scale;\n"},
     {"drop", "mask uint -> mask uint",
      "PathState path = new_path();\n"
      "path.vertices = in1;\n"
      "path_drop(&path, in0, HEALTH_PATH_TOO_LONG);\n"
      "path_drop(&path, to_mask(true), HEALTH_INVALID_RAY);\n"
      "path.active = to_mask(true);\n"
      "path_drop(&path, in0, HEALTH_NEGATIVE_PDF);\n"
      "out0 = path.active; out1 = path.accident;\n"},
     {"emission", "RenderSettings* float float mask -> float",
      "PathState path = new_path();\n"
      "path.pdf = in1; path.delta = in3;\n"
      "out0 = emission_weight(view_of(in0), &path, in2);\n"},
     {"roulette", "RenderSettings* float float uint uint -> mask float",
      "PathState path = new_path();\n"
      "path.throughput = vec3(0.5 * in1, in1, 0.25 * in1); path.radiance_scale = in2; path.vertices = in3;\n"
      "path_roulette(view_of(in0), &path, in4);\n"
      "out0 = path.active; out1 = path.throughput.y;\n"},
     {"end", "float float float uint -> float float float uint",
      "PathState path = new_path();\n"
      "path.radiance = vec3(in0, in1, in2); path.accident = in3; path.vertices = (Uint)(2u);\n"
      "Uint accident;\n"
      "Color radiance = path_end(&path, &accident);\n"
      "out0 = radiance.x; out1 = radiance.y; out2 = radiance.z; out3 = accident;\n"},
     {"random", "uint uint -> uint",
      "PathState path = new_path();\n"
      "path.vertices = in0;\n"
      "RandomBlock camera = random_block(path.stream, (Uint)(RANDOM_CAMERA));\n"
      "RandomBlock light = path_random(&path, RANDOM_LIGHT), bsdf = path_random(&path, RANDOM_BSDF);\n"
      "out0 = in1 == 0u ? camera.x : (in1 == 1u ? light.x : bsdf.x);\n"},
     {"sides", "float float -> mask",
      "Surface surface;\n"
      "surface.ng = vec3((Float)(0.0), (Float)(1.0), (Float)(0.0));\n"
      "out0 = sides_agree(surface, vec3((Float)(0.6), in0, (Float)(0.0)), vec3((Float)(0.0), (Float)(0.0), in1));\n"},
     {"scatter", "RenderSettings* Material* float* uint uint uint -> mask uint float float uint mask",
      "PathState path = new_path();\n"
      "path.stream.sample = in5;\n"
      "SceneView view = view_of(in0);\n"
      "view.materials = in1;\n"
      "view.parameters = in2;\n"
      "Surface surface;\n"
      "surface.p = black(); surface.p_error = (Float)(0x1p-20);\n"
      "surface.ng = surface.ns = surface.wo = vec3((Float)(0.0), (Float)(1.0), (Float)(0.0));\n"
      "surface.primitive = in4; surface.material = in3;\n"
      "MaterialLanes material = load_material(view, in3, to_mask(true));\n"
      "path_scatter(view, &path, surface, make_frame(surface.ns), material);\n"
      "out0 = path.active; out1 = path.accident; out2 = path.throughput.y; out3 = path.ray.origin.y;\n"
      "out4 = path.ray.from; out5 = path.delta;\n"},
     {"extend", "RenderSettings* BvhNode* uint* Primitive* float float float -> mask uint uint",
      "PathState path = new_path();\n"
      "SceneView view = view_of(in0);\n"
      "view.nodes = in1;\n"
      "view.leaf_primitives = in2;\n"
      "view.primitives = in3;\n"
      "path.ray.direction = vec3(in4, in5, in6);\n"
      "Hit hit = path_extend(view, &path);\n"
      "out0 = path.active; out1 = path.accident; out2 = hit.primitive;\n"}},
    DEFINITIONS, Specialization::everything(1, 32));

std::vector<RenderSettings> one(const RenderSettings& settings)
{
    return {settings};
}

uint code(uint kind, uint vertices)
{
    return kind + 1 + 16 * vertices;
}

constexpr float INFINITE = std::numeric_limits<float>::infinity();
const float NOT_A_NUMBER = std::nanf("");
} // namespace

TEST_CASE("a path begins anew in fresh lanes and goes on as it was in the others")
{
    RenderSettings settings{};
    settings.width = settings.height = 8;
    settings.camera.forward = make_real4(0, 0, -1);
    settings.camera.right = make_real4(1, 0, 0);
    settings.camera.up = make_real4(0, 1, 0);
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const std::vector<uint> fresh{1, 0, 1, 0, 0}, x{3, 4, 7, 1, 2}, y{3, 3, 0, 1, 2};
            const DeviceResults results = functions.evaluate(device, "begin", {one(settings), fresh, x, y}, lanes);
            for (std::size_t i = 0; i < fresh.size(); ++i) {
                const bool begins = fresh[i] != 0;
                CHECK(results.get<uint>(0)[i] == fresh[i]);
                CHECK(results.get<float>(1)[i] == (begins ? 1.0f : 0.5f));
                CHECK((results.get<float>(2)[i] == -1.0f) == !begins);
                CHECK(results.get<uint>(3)[i] == (begins ? 0 : 7));
                CHECK(results.get<uint>(4)[i] == (begins ? 0 : 9));
                CHECK(results.get<uint>(5)[i] == (begins ? NO_INDEX : 5));
                CHECK(results.get<uint>(6)[i] == fresh[i]);
                CHECK(results.get<float>(7)[i] == (begins ? 1.0f : 0.25f));
            }
        }
}

TEST_CASE("a path with an accident ends, and keeps its first accident with its vertex")
{
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults results =
                functions.evaluate(device, "drop", {std::vector<uint>{1, 0, 1}, std::vector<uint>{4, 4, 70000}}, lanes);
            CHECK(results.get<uint>(0) == std::vector<uint>{0, 1, 0});
            CHECK(results.get<uint>(1) == std::vector<uint>{code(HEALTH_PATH_TOO_LONG, 4), code(HEALTH_INVALID_RAY, 4),
                                                            code(HEALTH_PATH_TOO_LONG, 65535)});
        }
}

TEST_CASE("emission that a ray meets and a light sample of it share the path: their weights add up to one")
{
    const std::vector<float> pdf{1, 0.25f, 1e-20f, 1e20f, 3}, light_pdf{1, 4, 1e20f, 1e-20f, 0};
    const std::vector<uint> not_delta(5, 0), delta(5, 1);
    for (const Device& device : test_devices()) {
        const auto weights = [&](uint sample_lights, uint count_emission, const std::vector<uint>& is_delta,
                                 bool swapped = false) {
            RenderSettings settings{};
            settings.sample_lights = sample_lights;
            settings.count_emission = count_emission;
            return functions.evaluate<float>(
                device, "emission", {one(settings), swapped ? light_pdf : pdf, swapped ? pdf : light_pdf, is_delta});
        };
        const auto both = weights(1, 1, not_delta), other = weights(1, 1, not_delta, true);
        const double expected[] = {0.5, 0.0625 / 16.0625, 0, 1, 1};
        for (std::size_t i = 0; i < pdf.size(); ++i) {
            CHECK(both[i] == Approx(expected[i]).epsilon(1e-6));
            if (light_pdf[i] > 0) CHECK(double{both[i]} + other[i] == Approx(1).epsilon(1e-6));
        }
        CHECK(weights(0, 1, not_delta) == std::vector<float>(5, 1));
        CHECK(weights(1, 0, not_delta) == std::vector<float>(5, 0));
        // Light sampling cannot reach what a delta lobe leads to.
        for (const uint sample_lights : {0u, 1u})
            for (const uint count_emission : {0u, 1u})
                CHECK(weights(sample_lights, count_emission, delta) == std::vector<float>(5, 1));
    }
}

TEST_CASE("roulette lets exactly as many integers survive as the weight of the survivors makes up for")
{
    for (const Device& device : test_devices())
        for (const double survival : {0.8, 0.5, 1.1e-5, 0.015625, 0.9999999}) {
            RenderSettings settings{};
            settings.roulette = ROULETTE_CONSTANT;
            settings.roulette_parameters = make_real4(survival, 0, 0);
            settings.roulette_start = 2;
            // The number of integers that survive, by bisection on the device's own answer.
            std::uint64_t low = 0, high = std::uint64_t{1} << 32; // low survives or is 0, high does not
            float weight = 0;
            while (high - low > 1) {
                const std::uint64_t middle = (low + high) / 2;
                const DeviceResults results =
                    functions.evaluate(device, "roulette",
                                       {one(settings), std::vector<float>{1}, std::vector<float>{1},
                                        std::vector<uint>{2}, std::vector<uint>{static_cast<uint>(middle)}},
                                       1);
                const bool survives = results.get<uint>(0)[0] != 0;
                (survives ? low : high) = middle;
                if (survives) weight = results.get<float>(1)[0];
            }
            CAPTURE(survival);
            const double probability = std::ldexp(static_cast<double>(high), -32);
            CHECK(std::abs(probability - survival) <= 1e-7 * survival + 0x1p-32);
            CHECK(probability * weight == Approx(1).epsilon(3 * 0x1p-24));
        }
}

TEST_CASE("roulette by throughput looks through refraction, never drops below its floor, and waits for its start")
{
    RenderSettings settings{};
    settings.roulette = ROULETTE_THROUGHPUT;
    settings.roulette_start = 3;
    //                                  plays, too early, over 1,  refracted, floor, floor, off by scale
    const std::vector<float> throughput{0.5f, 0.5f, 1.5f, 0.25f, 1e-4f, 1e-4f, 0.5f};
    const std::vector<float> scale{1, 1, 1, 0.25f, 1, 1, 1};
    const std::vector<uint> vertices{3, 2, 9, 9, 9, 9, 9};
    const std::vector<uint> bits{0x7fffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu,
                                 0x03ffffffu, 0x04000000u, 1u << 31};
    const std::vector<uint> survives{1, 1, 1, 1, 1, 0, 0};
    const std::vector<float> after{1, 0.5f, 1.5f, 0.25f, 64e-4f, 64e-4f, 1};
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults results =
                functions.evaluate(device, "roulette", {one(settings), throughput, scale, vertices, bits}, lanes);
            CHECK(results.get<uint>(0) == survives);
            for (std::size_t i = 0; i < after.size(); ++i)
                CHECK(results.get<float>(1)[i] == Approx(after[i]).epsilon(1e-6));
        }
    RenderSettings off{};
    for (const Device& device : test_devices())
        CHECK(functions.evaluate(device, "roulette", {one(off), throughput, scale, vertices, bits}).get<uint>(0) ==
              std::vector<uint>(7, 1));
}

TEST_CASE("a path that ends with an accident counts as zero and says which was the first")
{
    const std::vector<float> x{1, NOT_A_NUMBER, INFINITE, -1, 1, -0.0f, 0}, y{2, 2, 2, 2, 2, 2, -INFINITE};
    const std::vector<uint> before{0, 0, 0, 0, 21, 0, 0};
    const std::vector<uint> accidents{0,
                                      code(HEALTH_NON_FINITE_RADIANCE, 2),
                                      code(HEALTH_NON_FINITE_RADIANCE, 2),
                                      code(HEALTH_NEGATIVE_RADIANCE, 2),
                                      21,
                                      0,
                                      code(HEALTH_NON_FINITE_RADIANCE, 2)};
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            // Each of the three channels may be the one.
            for (const bool swapped : {false, true}) {
                const DeviceResults results = functions.evaluate(
                    device, "end", {swapped ? y : x, std::vector<float>(7, 3), swapped ? x : y, before}, lanes);
                CHECK(results.get<uint>(3) == accidents);
                CHECK(results.get<float>(1) == std::vector<float>{3, 0, 0, 0, 0, 3, 0});
                CHECK(results.get<float>(swapped ? 2 : 0) == std::vector<float>{1, 0, 0, 0, 0, 0, 0});
            }
        }
}

TEST_CASE("no two draws of a path share a random block")
{
    std::vector<uint> vertices, role;
    for (uint v = 0; v < 2000; ++v)
        for (const uint r : {1u, 2u}) {
            vertices.push_back(v);
            role.push_back(r);
        }
    vertices.push_back(0);
    role.push_back(0);
    for (const Device& device : test_devices()) {
        const auto drawn = functions.evaluate<uint>(device, "random", {vertices, role});
        // 4001 random integers are distinct but for a chance of 0.2 %; the seed is fixed.
        CHECK(std::set<uint>(drawn.begin(), drawn.end()).size() == drawn.size());
    }
}

TEST_CASE("a direction leaves on one side only: those of the two normals must agree")
{
    for (const Device& device : test_devices())
        CHECK(functions.evaluate<uint>(device, "sides",
                                       {std::vector<float>{1, 1, -1, -1}, std::vector<float>{1, -1, 1, -1}}) ==
              std::vector<uint>{1, 0, 0, 1});
}

TEST_CASE("scattering multiplies the throughput, leaves the surface, and drops what is no number or negative")
{
    // Diffuse 0.5, diffuse NaN, diffuse negative, mirror 0.25, diffuse black.
    const std::vector<float> parameters{0.5f, 0.5f,  0.5f,  NOT_A_NUMBER, 0.5f, 0.5f, 0.5f, -1,
                                        0.5f, 0.25f, 0.25f, 0.25f,        0,    0,    0};
    std::vector<Material> materials;
    for (uint i = 0; i < 5; ++i)
        materials.push_back({i == 3 ? static_cast<uint>(BSDF_MIRROR) : static_cast<uint>(BSDF_DIFFUSE), 0, 3 * i, 0});
    const std::vector<uint> material{0, 1, 2, 3, 4}, primitive{10, 11, 12, 13, 14}, sample{1, 2, 3, 4, 5};
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults results = functions.evaluate(
                device, "scatter", {one({}), materials, parameters, material, primitive, sample}, lanes);
            CHECK(results.get<uint>(0) == std::vector<uint>{1, 0, 0, 1, 0});
            CHECK(results.get<uint>(1) ==
                  std::vector<uint>{0, code(HEALTH_NON_FINITE_PDF, 0), code(HEALTH_NEGATIVE_PDF, 0), 0, 0});
            CHECK(results.get<float>(2)[0] == 0.5f);
            CHECK(results.get<float>(2)[3] == 0.25f);
            CHECK(results.get<float>(3)[0] == 0x1p-20f);
            CHECK(results.get<uint>(4) == std::vector<uint>{10, NO_INDEX, NO_INDEX, 13, NO_INDEX});
            CHECK(results.get<uint>(5)[0] == 0);
            CHECK(results.get<uint>(5)[3] == 1);
        }
}

TEST_CASE("a ray that is none ends its path with an accident, and the other lanes are traced")
{
    RenderSettings settings{};
    settings.accelerator = ACCELERATOR_BRUTE_FORCE;
    settings.primitive_count = 1;
    const std::vector<Primitive> triangle{{make_real4(-1, -1, -2), make_real4(1, -1, -2), make_real4(0, 1, -2)}};
    const std::vector<float> x{0, NOT_A_NUMBER, 0, 0, 0}, y{0, 0, 0, INFINITE, 0}, z{-1, -1, 0, -1, 1};
    const uint invalid = code(HEALTH_INVALID_RAY, 0);
    for (const Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults results = functions.evaluate(
                device, "extend", {one(settings), std::vector<BvhNode>(1), std::vector<uint>(1), triangle, x, y, z},
                lanes);
            CHECK(results.get<uint>(0) == std::vector<uint>{1, 0, 0, 0, 1});
            CHECK(results.get<uint>(1) == std::vector<uint>{0, invalid, invalid, invalid, 0});
            CHECK(results.get<uint>(2) == std::vector<uint>{0, NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX});
        }
}
} // namespace etendue
