// Frames around normals: orthonormal everywhere, the poles included.
#include "support/device_evaluate.h"

#include "math/vector.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace etendue;

namespace
{
const DeviceFunctions functions(
    {"math/frame.h"},
    {
        {"frame", "float float float -> float float float float float float float float float",
         "Frame f = make_frame(vec3(in0, in1, in2)); out0 = f.s.x; out1 = f.s.y; out2 = f.s.z; out3 = f.t.x; out4 = "
         "f.t.y; out5 = f.t.z; out6 = f.n.x; out7 = f.n.y; out8 = f.n.z;"},
        {"there_and_back", "float float float float float float -> float float float float float float",
         "Frame f = make_frame(vec3(in0, in1, in2)); Vec3 a = to_local(f, vec3(in3, in4, in5)); Vec3 b = to_world(f, a); "
         "out0 = a.x; out1 = a.y; out2 = a.z; out3 = b.x; out4 = b.y; out5 = b.z;"},
        {"same_side", "float float -> mask",
         "same_hemisphere(vec3((Float)(0.5f), (Float)(0.5f), in0), vec3((Float)(0.5f), (Float)(-0.5f), in1))"},
    });

constexpr double UNIT_ROUNDOFF = 0x1p-24;

struct Normals {
    std::vector<float> x, y, z;

    void add(const Vec3& n)
    {
        x.push_back(static_cast<float>(n.x));
        y.push_back(static_cast<float>(n.y));
        z.push_back(static_cast<float>(n.z));
    }
};

// A spiral over the sphere, then angles of 1e-3 down to nothing from +z and -z, then the axes.
Normals make_normals()
{
    Normals normals;
    constexpr int SPIRAL = 1 << 15, NEAR = 1 << 14;
    const auto add = [&](double z, double radius, double angle) {
        normals.add(glm::normalize(Vec3(radius * std::cos(angle), radius * std::sin(angle), z)));
    };
    for (int i = 0; i < SPIRAL; ++i) {
        const double z = (2.0 * i + 1.0) / SPIRAL - 1.0;
        add(z, std::sqrt(1.0 - z * z), 2.399963 * i);
    }
    for (int i = 0; i < NEAR; ++i)
        for (const double pole : {1.0, -1.0}) add(pole, 1e-3 * std::pow(i / double{NEAR}, 4), 2.399963 * i);
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            Vec3 n(-0.0);
            n[axis] = sign;
            normals.add(n);
        }
    return normals;
}
} // namespace

TEST_CASE("the frame of a unit normal is orthonormal to 4 u and right-handed, near the poles too")
{
    const Normals normals = make_normals();
    REQUIRE(normals.x.size() > 1u << 16);
    for (Device& device : test_devices()) {
        const DeviceResults out = functions.evaluate(device, "frame", {normals.x, normals.y, normals.z});
        std::vector<float> v[9];
        for (std::size_t k = 0; k < 9; ++k) v[k] = out.get<float>(k);
        double error = 0.0, least_handedness = 1.0;
        for (std::size_t i = 0; i < normals.x.size(); ++i) {
            const Vec3 s(v[0][i], v[1][i], v[2][i]), t(v[3][i], v[4][i], v[5][i]), n(v[6][i], v[7][i], v[8][i]);
            REQUIRE(n == Vec3(normals.x[i], normals.y[i], normals.z[i]));
            for (const double deviation : {glm::length(s) - 1.0, glm::length(t) - 1.0, glm::dot(s, t), glm::dot(s, n),
                                           glm::dot(t, n)}) {
                REQUIRE(std::isfinite(deviation));
                error = std::fmax(error, std::fabs(deviation));
            }
            least_handedness = std::fmin(least_handedness, glm::dot(glm::cross(s, t), n));
        }
        CHECK(error <= 4.0 * UNIT_ROUNDOFF);
        CHECK(least_handedness > 0.999999);
    }
}

TEST_CASE("a direction keeps its cosine to the normal in the local frame and comes back from it")
{
    const Normals normals = make_normals();
    // Each normal's direction is the normal a third of the list later.
    Normals w = normals;
    for (auto* axis : {&w.x, &w.y, &w.z})
        std::rotate(axis->begin(), axis->begin() + static_cast<std::ptrdiff_t>(axis->size() / 3), axis->end());
    for (Device& device : test_devices()) {
        const DeviceResults out =
            functions.evaluate(device, "there_and_back", {normals.x, normals.y, normals.z, w.x, w.y, w.z});
        std::vector<float> v[6];
        for (std::size_t k = 0; k < 6; ++k) v[k] = out.get<float>(k);
        double error = 0.0;
        for (std::size_t i = 0; i < w.x.size(); ++i) {
            const Vec3 n(normals.x[i], normals.y[i], normals.z[i]), world(w.x[i], w.y[i], w.z[i]);
            error = std::fmax(error, std::fabs(v[2][i] - glm::dot(world, n)));
            error = std::fmax(error, glm::length(Vec3(v[3][i], v[4][i], v[5][i]) - world));
        }
        CHECK(error <= 16.0 * UNIT_ROUNDOFF);
    }
}

TEST_CASE("directions along the surface are in no hemisphere")
{
    const std::vector<float> a{1.0f, -1.0f, 1.0f, 0.0f, -0.0f, 0.0f, -1e-30f}, b{1e-30f, -1.0f, -1.0f, 1.0f, -1.0f, 0.0f, -1.0f};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS)
            CHECK(functions.evaluate<std::uint32_t>(device, "same_side", {a, b}, lanes) ==
                  std::vector<std::uint32_t>{1, 1, 0, 0, 0, 0, 1});
}
