// Rules about a scene as a whole.
#include "scene/scene_check.h"

#include <algorithm>
#include <cmath>

namespace etendue
{
namespace
{
// The sine of the angle between up and the line of sight below which "right" is only rounding error.
constexpr double PARALLEL = 1e-12;

void check_camera(const CameraDescription& camera)
{
    const Vec3 forward = camera.look_at - camera.position;
    if (!(glm::length(forward) > 0)) throw SceneError(camera.location, "position and look_at are the same point");
    const double sine = glm::length(glm::cross(glm::normalize(forward), camera.up)) / glm::length(camera.up);
    if (!(sine > PARALLEL)) throw SceneError(camera.location, "up is zero or points along the line of sight");
}

void check_end_of_paths(const IntegratorDescription& integrator)
{
    if (!integrator.max_depth && integrator.roulette == RouletteType::off)
        throw SceneError(integrator.location, "max_depth is unlimited and roulette is off, so a path might never end; "
                                              "set a max_depth or choose roulette constant or throughput");
    if (!integrator.max_depth && integrator.roulette == RouletteType::constant &&
        integrator.roulette_probability >= 1.0)
        throw SceneError(integrator.location, "max_depth is unlimited and roulette lets every path survive, so a path "
                                              "might never end; set a max_depth or a probability less than 1");
}

} // namespace

bool is_lit(const Scene& scene)
{
    const auto shines = [](const Vec3& radiance) { return radiance != Vec3(0.0); };
    return (scene.environment && shines(scene.environment->radiance)) ||
           std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const ShapeDescription& shape) {
               return shape.emission && shines(shape.emission->radiance);
           });
}

std::vector<std::string> check_scene(const Scene& scene)
{
    if (scene.shapes.empty() && !scene.environment)
        throw SceneError(scene.file + ": the scene is empty: it has no shapes, no lights and no environment");
    check_camera(scene.camera);
    check_end_of_paths(scene.integrator);

    std::vector<std::string> warnings;
    if (!is_lit(scene) && scene.integrator.type != IntegratorType::normals)
        warnings.push_back(scene.file + ": nothing in the scene emits light, so the picture will be black.");
    return warnings;
}
} // namespace etendue
