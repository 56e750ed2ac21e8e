// Rays of the pinhole camera against its geometry in double precision.
#include "support/device_evaluate.h"

#include "geometry/camera.h"
#include "math/vector.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace etendue;

namespace
{
constexpr int WIDTH = 640, HEIGHT = 360;

const DeviceFunctions functions(
    {"camera/pinhole.h"},
    {
        {"ray", "Camera* float float -> float float float float float float float uint uint",
         "Ray r = pinhole_ray(in0, in1, in2, 640u, 360u); out0 = r.origin.x; out1 = r.origin.y; out2 = r.origin.z; "
         "out3 "
         "= r.direction.x; out4 = r.direction.y; out5 = r.direction.z; out6 = r.t_max; out7 = r.from; out8 = r.to;"},
    });

CameraDescription description()
{
    CameraDescription camera;
    camera.position = Vec3(1.0, 2.0, 5.0);
    camera.look_at = Vec3(0.5, -1.0, -2.0);
    camera.up = Vec3(0.1, 1.0, 0.0);
    camera.vertical_fov = 50.0;
    return camera;
}

struct Rays {
    std::vector<Vec3> origins, directions;
    std::vector<float> t_max;
    std::vector<std::uint32_t> from, to;
};

Rays trace(const Device& device, const std::vector<float>& x, const std::vector<float>& y, std::uint32_t lanes = 0)
{
    const Camera camera = make_camera(description(), WIDTH, HEIGHT, {});
    const DeviceResults out = functions.evaluate(device, "ray", {std::vector<Camera>{camera}, x, y}, lanes);
    Rays rays{{}, {}, out.get<float>(6), out.get<std::uint32_t>(7), out.get<std::uint32_t>(8)};
    for (std::size_t i = 0; i < x.size(); ++i) {
        rays.origins.emplace_back(out.get<float>(0)[i], out.get<float>(1)[i], out.get<float>(2)[i]);
        rays.directions.emplace_back(out.get<float>(3)[i], out.get<float>(4)[i], out.get<float>(5)[i]);
    }
    return rays;
}
} // namespace

TEST_CASE("camera rays go from the camera through their place on the film, with unit directions")
{
    const CameraDescription camera = description();
    const Vec3 forward = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const Vec3 up = glm::cross(right, forward);
    const double tangent = std::tan(glm::radians(camera.vertical_fov / 2.0));

    // The corners, the centre, and places between them.
    const std::vector<float> x{0.0f, 640.0f, 0.0f, 640.0f, 320.0f, 100.25f, 639.5f};
    const std::vector<float> y{0.0f, 0.0f, 360.0f, 360.0f, 180.0f, 300.75f, 0.5f};
    for (Device& device : test_devices())
        for (const std::uint32_t lanes : LANE_COUNTS) {
            const Rays rays = trace(device, x, y, lanes);
            for (std::size_t i = 0; i < x.size(); ++i) {
                // The film at distance 1 is 2 tan(fov / 2) high, and its pixels are squares of this side.
                const double side = 2.0 * tangent / HEIGHT;
                const Vec3 expected = glm::normalize(forward + right * ((x[i] - WIDTH / 2.0) * side) -
                                                     up * ((y[i] - HEIGHT / 2.0) * side));
                INFO("place " << x[i] << ", " << y[i] << ", " << lanes << " lanes");
                CHECK(glm::length(rays.directions[i] - expected) <= 5e-7);
                CHECK(std::fabs(glm::length(rays.directions[i]) - 1.0) <= 3e-7);
                CHECK(rays.origins[i] == camera.position);
                CHECK(std::isinf(rays.t_max[i]));
                CHECK(rays.from[i] == NO_INDEX);
                CHECK(rays.to[i] == NO_INDEX);
            }
        }
}

TEST_CASE("the right of the picture is the camera's right, and its first row is at the top")
{
    const CameraDescription camera = description();
    const Vec3 right = glm::cross(camera.look_at - camera.position, camera.up);
    for (Device& device : test_devices()) {
        const auto directions =
            trace(device, {0.5f, 639.5f, 320.0f, 320.0f}, {180.0f, 180.0f, 0.5f, 359.5f}).directions;
        CHECK(glm::dot(directions[0], right) < 0.0);
        CHECK(glm::dot(directions[1], right) > 0.0);
        CHECK(glm::dot(directions[2], camera.up) > glm::dot(directions[3], camera.up));
    }
}
