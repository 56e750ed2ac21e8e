// The camera's frame.
#include "geometry/camera.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace etendue;

namespace
{
Vec3 vec3(const real4& v)
{
    return {v.s[0], v.s[1], v.s[2]};
}
} // namespace

TEST_CASE("the course's camera has the frame of its formulas")
{
    const Camera camera = make_camera({}, 600, 300, {});
    const double half_height = std::tan(19.5 / 2 * 3.14159265358979323846 / 180);
    CHECK(vec3(camera.position) == Vec3(0, 1, 6.8f));
    CHECK(vec3(camera.forward) == Vec3(0, 0, -1));
    CHECK(glm::length(vec3(camera.up) - Vec3(0, half_height, 0)) <= 1e-8);
    CHECK(glm::length(vec3(camera.right) - Vec3(2 * half_height, 0, 0)) <= 1e-8);
}

TEST_CASE("the focal length multiplies the tangent, and up need not be perpendicular or unit")
{
    CameraDescription description;
    description.vertical_fov = 90;
    description.focal_length = 2.5;
    description.up = {0, 1e-200, 3e-200};
    const Camera camera = make_camera(description, 100, 100, {});
    CHECK(glm::length(vec3(camera.up) - Vec3(0, 2.5, 0)) <= 1e-6);
    CHECK(glm::length(vec3(camera.right) - Vec3(2.5, 0, 0)) <= 1e-6);
}

TEST_CASE("the camera moves and scales with the normalisation, its directions do not")
{
    const Camera plain = make_camera({}, 4, 3, {});
    const Camera moved = make_camera({}, 4, 3, {Vec3(1, 2, 3), 0.25});
    CHECK(vec3(moved.position) == Vec3(-0.25, -0.25, static_cast<float>((6.8 - 3) / 4)));
    CHECK(vec3(moved.forward) == vec3(plain.forward));
    CHECK(vec3(moved.right) == vec3(plain.right));
    CHECK(vec3(moved.up) == vec3(plain.up));
}

TEST_CASE("a camera without a frame is refused at its place in the scene")
{
    CameraDescription description;
    description.location.file = "s.json";
    description.location.line = 3;
    description.location.column = 5;
    description.location.pointer = "/camera";
    const auto fails = [&](const std::string& message) {
        CHECK_THROWS_AS(make_camera(description, 4, 3, {}), SceneError);
        CHECK_THROWS_WITH(make_camera(description, 4, 3, {}), "s.json:3:5: /camera: " + message);
    };
    description.look_at = description.position;
    fails("the camera looks at its own position.");
    description.look_at = {0, 5, 6.8};
    fails("the camera's up vector is zero or parallel to its view direction.");
    description.up = {0, 0, 0};
    fails("the camera's up vector is zero or parallel to its view direction.");
    description.up = {0, 0, 1};
    description.position = {0, 1e39, 6.8};
    fails("the camera is too far away from the geometry, or its angle is too wide.");
}
