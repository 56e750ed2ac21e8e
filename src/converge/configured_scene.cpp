// Overrides of the native format's settings, also where a scene is of the course's format, which has none.
#include "converge/configuration.h"

#include "scene/scene_tables.h"
#include "util/sha256.h"

#include <fmt/format.h>

namespace etendue
{
namespace
{
bool is_of_section(const std::string& override)
{
    for (const char* const section : {"integrator", "sampler", "accelerator"})
        for (const std::string& begin : {std::string(section), '/' + std::string(section)})
            for (const char next : {'.', '/', '='})
                if (override.rfind(begin + next, 0) == 0) return true;
    return false;
}

std::string name_of(const Table& table, std::size_t variant)
{
    return table.variant_names().at(variant);
}

std::string roulette_text(const IntegratorDescription& integrator)
{
    const std::string type = name_of(roulette_table(), static_cast<std::size_t>(integrator.roulette));
    if (integrator.roulette == RouletteType::off) return fmt::format(R"("{}")", type);
    const std::string probability = integrator.roulette == RouletteType::constant
                                        ? fmt::format(R"("probability": {}, )", integrator.roulette_probability)
                                        : "";
    return fmt::format(R"({{"type": "{}", {}"start": {}}})", type, probability, integrator.roulette_start);
}

// The settings of a scene as a scene of its own in the native format.
std::string settings_text(const Scene& scene)
{
    const IntegratorDescription& integrator = scene.integrator;
    const std::string depth = integrator.max_depth ? std::to_string(*integrator.max_depth) : "\"unlimited\"";
    return fmt::format(
        R"({{"integrator": {{"type": "{}", "max_depth": {}, "roulette": {}}}, "sampler": {{"type": "{}", "spp": {}, )"
        R"("seed": {}}}, "environment": {{"radiance": 1}}}})",
        name_of(integrator_table(), static_cast<std::size_t>(integrator.type)), depth, roulette_text(integrator),
        name_of(sampler_table(), static_cast<std::size_t>(scene.sampler.type)), scene.sampler.samples_per_pixel,
        scene.sampler.seed);
}
} // namespace

LoadedScene load_configured(const std::string& path, const std::vector<std::string>& overrides)
{
    std::vector<std::string> of_scene, of_sections;
    for (const std::string& override : overrides)
        (is_of_section(override) ? of_sections : of_scene).push_back(override);
    LoadedScene loaded = load_scene(path, of_scene);
    if (of_sections.empty()) return loaded;
    if (!loaded.scene.course_format) return load_scene(path, overrides);

    const Scene settings = parse_scene(settings_text(loaded.scene), path, of_sections).scene;
    loaded.scene.integrator = settings.integrator;
    loaded.scene.sampler = settings.sampler;
    loaded.scene.accelerator = settings.accelerator;
    loaded.scene.sha256 = sha256(loaded.scene.sha256 + settings.sha256);
    return loaded;
}
} // namespace etendue
