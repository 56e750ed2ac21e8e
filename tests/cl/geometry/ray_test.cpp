// Rays and hits: which rays can be traced, and which of several candidates stays.
#include "check/rays.h"
#include "support/device_evaluate.h"

#include <catch2/catch.hpp>

#include <limits>
#include <numeric>

using namespace etendue;

namespace
{
const DeviceFunctions
    functions({"geometry/ray.h"},
              {{"valid", "float float float float float float float -> mask",
                "Ray ray = {vec3(in0, in1, in2), vec3(in3, in4, in5), in6, (Uint)(NO_INDEX), (Uint)(NO_INDEX)};\n"
                "out0 = is_valid_ray(ray);"},
               {"none", "float -> float uint float float",
                "Hit hit = no_hit(in0); out0 = hit.t; out1 = hit.primitive; out2 = hit.b1; out3 = hit.b2;"},
               {"accept", "float uint float uint -> mask",
                "Hit hit = {in0, in1, (Float)(0.0), (Float)(0.0)}; out0 = hit_accept(hit, in2, in3);"},
               {"update", "mask float uint -> float uint float float",
                "Hit hit = {(Float)(9.0), (Uint)(90u), (Float)(0.25), (Float)(0.5)};\n"
                "hit_update(&hit, in0, in1, in2, in1 + 1.0f, in1 + 2.0f);\n"
                "out0 = hit.t; out1 = hit.primitive; out2 = hit.b1; out3 = hit.b2;"}});

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
constexpr float INFINITE = std::numeric_limits<float>::infinity();
} // namespace

TEST_CASE("a ray is valid when all of it is finite and it has a direction, t_max may be infinite")
{
    std::array<std::vector<float>, 7> columns;
    std::vector<std::uint32_t> expected;
    const auto add = [&](const std::array<float, 7>& ray, bool valid) {
        for (std::size_t i = 0; i < 7; ++i) columns[i].push_back(ray[i]);
        expected.push_back(valid);
    };
    const std::array<float, 7> good{1, -2, 3, 0, 0, -1, 5};
    add(good, true);
    for (std::size_t i = 0; i < 7; ++i)
        for (const float bad : {NOT_A_NUMBER, -NOT_A_NUMBER, INFINITE, -INFINITE}) {
            std::array<float, 7> ray = good;
            ray[i] = bad;
            add(ray, i == 6 && bad == INFINITE);
        }
    add({0, 0, 0, 0, 0, 0, 5}, false);
    add({0, 0, 0, -0.0f, 0, -0.0f, 5}, false);
    add({0, 0, 0, 0, 1e-30f, 0, 5}, true);
    add({0, 0, 0, 1, 0, 0, 0}, true);
    add({0, 0, 0, 1, 0, 0, -1}, false);
    add({3e38f, -3e38f, 0, 3e38f, -3e38f, 3e38f, 3e38f}, true);
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<std::uint32_t>(device, "valid", {columns.begin(), columns.end()}, lanes) ==
                  expected);
}

TEST_CASE("no hit is at t_max and names no primitive")
{
    for (Device& device : test_devices()) {
        const DeviceResults out = functions.evaluate(device, "none", {std::vector<float>{2.5f, INFINITE}});
        CHECK(out.get<float>(0) == std::vector<float>{2.5f, INFINITE});
        CHECK(out.get<std::uint32_t>(1) == std::vector<std::uint32_t>{NO_INDEX, NO_INDEX});
        CHECK(out.get<float>(2) == std::vector<float>{0, 0});
        CHECK(out.get<float>(3) == std::vector<float>{0, 0});
    }
}

TEST_CASE("the nearer hit is accepted, of equal ones the lowest primitive, and only ahead of the origin")
{
    struct Case {
        float t;
        std::uint32_t primitive;
        float new_t;
        std::uint32_t new_primitive;
        bool accepted;
    };
    const std::vector<Case> cases{
        {2, 5, 1, 9, true},
        {2, 5, 3, 1, false},
        {2, 5, 2, 4, true},
        {2, 5, 2, 6, false},
        {2, 5, 2, 5, false},
        {2, 5, 0, 1, false},
        {2, 5, -0.0f, 1, false},
        {2, 5, -1, 1, false},
        {2, 5, NOT_A_NUMBER, 1, false},
        {INFINITE, NO_INDEX, 1e30f, 7, true},
        // A hit at t_max counts.
        {2, NO_INDEX, 2, 7, true},
        {2, NO_INDEX, 2, 0x80000001u, true},
        // Primitives compare as unsigned numbers.
        {2, 0x80000001u, 2, 3, true},
        {2, 3, 2, 0x80000001u, false},
        {2, 3, 1e-45f, 4, true},
    };
    std::vector<float> t, new_t;
    std::vector<std::uint32_t> primitive, new_primitive, expected;
    for (const Case& c : cases) {
        t.push_back(c.t);
        new_t.push_back(c.new_t);
        primitive.push_back(c.primitive);
        new_primitive.push_back(c.new_primitive);
        expected.push_back(c.accepted);
    }
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<std::uint32_t>(device, "accept", {t, primitive, new_t, new_primitive}, lanes) ==
                  expected);
}

TEST_CASE("an update takes all of an accepted candidate and nothing of another")
{
    std::vector<float> t(19);
    std::iota(t.begin(), t.end(), 1.0f);
    std::vector<std::uint32_t> accepted, primitive;
    for (std::uint32_t i = 0; i < t.size(); ++i) {
        accepted.push_back(i % 3 == 1);
        primitive.push_back(i + 100);
    }
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const DeviceResults out = functions.evaluate(device, "update", {accepted, t, primitive}, lanes);
            for (std::size_t i = 0; i < t.size(); ++i) {
                CHECK(out.get<float>(0)[i] == (accepted[i] ? t[i] : 9.0f));
                CHECK(out.get<std::uint32_t>(1)[i] == (accepted[i] ? primitive[i] : 90u));
                CHECK(out.get<float>(2)[i] == (accepted[i] ? t[i] + 1 : 0.25f));
                CHECK(out.get<float>(3)[i] == (accepted[i] ? t[i] + 2 : 0.5f));
            }
        }
}
