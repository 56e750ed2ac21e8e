// Reading the native scene format by its tables.
#include "scene/scene_parser.h"

#include "scene/expectation_parser.h"
#include "scene/fields.h"
#include "scene/material_parser.h"
#include "scene/scene_tables.h"
#include "scene/shape_parser.h"

#include <algorithm>

namespace etendue
{
namespace
{
// Fields of the object at `key`; without it, of an empty object, so that the defaults of the table hold.
class Section
{
public:
    Section(const Fields& parent, const std::string& key, const Table& table)
        : empty_("{}", "default " + key), fields_(parent.has(key) ? parent.at(key) : empty_.root(), table),
          location_(parent.has(key) ? parent.at(key).location() : parent.object().location())
    {
    }
    const Fields* operator->() const { return &fields_; }
    const Fields& operator*() const { return fields_; }
    const SourceLocation& location() const { return location_; }

private:
    json::Document empty_;
    Fields fields_;
    SourceLocation location_;
};

CameraDescription parse_camera(const Fields& scene)
{
    const Section camera(scene, "camera", camera_table());
    return {camera->vector3("position"),    camera->vector3("look_at"),     camera->vector3("up"),
            camera->number("vertical_fov"), camera->number("focal_length"), camera.location()};
}

FilmDescription parse_film(const Fields& scene)
{
    const Section film(scene, "film", film_table());
    const Section filter(*film, "filter", filter_table());
    FilmDescription description;
    const glm::u64vec2 size = film->size2("size");
    description.width = static_cast<int>(size.x);
    description.height = static_cast<int>(size.y);
    description.filter = static_cast<FilterType>(filter->variant());
    description.filter_radius = filter->number("radius");
    if (description.filter == FilterType::gaussian) description.filter_sigma = filter->number("sigma");
    description.tone_map = static_cast<ToneMap>(film->name("tone_map"));
    description.exposure = film->number("exposure");
    description.location = film.location();
    return description;
}

IntegratorDescription parse_integrator(const Fields& scene)
{
    const Section integrator(scene, "integrator", integrator_table());
    const Section roulette(*integrator, "roulette", roulette_table());
    IntegratorDescription description;
    description.type = static_cast<IntegratorType>(integrator->variant());
    description.max_depth.reset();
    if (const auto depth = integrator->depth("max_depth")) description.max_depth = static_cast<std::uint32_t>(*depth);
    description.heuristic = static_cast<MisHeuristic>(integrator->name("heuristic"));
    description.sphere_lights = static_cast<SphereLights>(integrator->name("sphere_lights"));
    description.roulette = static_cast<RouletteType>(roulette->variant());
    if (description.roulette == RouletteType::constant)
        description.roulette_probability = roulette->number("probability");
    if (description.roulette != RouletteType::off)
        description.roulette_start = static_cast<std::uint32_t>(roulette->integer("start"));
    description.location = integrator.location();
    return description;
}

SamplerDescription parse_sampler(const Fields& scene)
{
    const Section sampler(scene, "sampler", sampler_table());
    SamplerDescription description;
    description.type = static_cast<SamplerType>(sampler->variant());
    description.samples_per_pixel = sampler->integer("spp");
    description.seed = sampler->integer("seed");
    if (description.type == SamplerType::sobol)
        description.replicates = static_cast<std::uint32_t>(sampler->integer("replicates"));
    description.location = sampler.location();
    return description;
}

AcceleratorDescription parse_accelerator(const Fields& scene)
{
    const Section accelerator(scene, "accelerator", accelerator_table());
    AcceleratorDescription description;
    // The first name of the table is "auto", the others are those of ACCELERATOR_LIST.
    if (accelerator->variant() > 0) description.type = static_cast<AcceleratorType>(accelerator->variant() - 1);
    description.build = static_cast<BuildPlace>(accelerator->name("build"));
    description.location = accelerator.location();
    return description;
}
} // namespace

Scene parse_native_scene(const json::Value& root, const std::string& folder)
{
    const Fields fields(root, scene_table());
    Scene scene;
    scene.folder = folder;
    scene.camera = parse_camera(fields);
    scene.film = parse_film(fields);
    scene.integrator = parse_integrator(fields);
    scene.sampler = parse_sampler(fields);
    scene.accelerator = parse_accelerator(fields);
    scene.materials = parse_materials(fields.objects("materials"));
    parse_shapes(fields.objects("shapes"), fields.objects("lights"), scene);
    if (fields.has("environment")) {
        const Fields environment(fields.at("environment"), environment_table());
        scene.environment = {environment.colour("radiance"), environment.object().location()};
    }
    if (fields.has("expect")) scene.expectation = parse_expectation(fields.at("expect"));
    return scene;
}
} // namespace etendue
