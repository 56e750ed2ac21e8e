// Settings from scene and geometry.
#include "render/render_settings.h"

#include <bit>
#include <cmath>

namespace etendue
{
namespace
{
// Up to so many primitives, testing each of them is faster than asking a tree. Measured with tests/bench/lanes.cpp: 12
// triangles (the furnace) 1.09 times with 16 lanes and 0.76 times with one, 36 (the course box) 0.87 times and 1.02
// times.
constexpr std::size_t BRUTE_FORCE_LIMIT_WIDE = 20;
constexpr std::size_t BRUTE_FORCE_LIMIT_SCALAR = 4;

uint filter_number(FilterType type)
{
    switch (type) {
    case FilterType::tent:
        return FILTER_TENT;
    case FilterType::gaussian:
        return FILTER_GAUSSIAN;
    case FilterType::box:
        break;
    }
    return FILTER_BOX;
}

uint roulette_number(RouletteType type)
{
    switch (type) {
    case RouletteType::constant:
        return ROULETTE_CONSTANT;
    case RouletteType::throughput:
        return ROULETTE_THROUGHPUT;
    case RouletteType::off:
        break;
    }
    return ROULETTE_OFF;
}

uint sampler_number(SamplerType type)
{
    switch (type) {
    case SamplerType::stratified:
        return SAMPLER_STRATIFIED;
    case SamplerType::sobol:
        return SAMPLER_SOBOL;
    case SamplerType::independent:
        break;
    }
    return SAMPLER_INDEPENDENT;
}

// Radius, standard deviation, and the part of a round Gaussian within the radius.
real4 filter_parameters(const FilmDescription& film)
{
    const double ratio = film.filter_radius / film.filter_sigma;
    return make_real4(film.filter_radius, film.filter_sigma, -std::expm1(-0.5 * ratio * ratio));
}

void set_integrator(RenderSettings& settings, const IntegratorDescription& integrator, bool has_lights)
{
    const auto type = integrator.type;
    settings.max_depth = integrator.max_depth.value_or(NO_INDEX);
    settings.sample_lights = has_lights && (type == IntegratorType::light || type == IntegratorType::path);
    settings.count_emission = type != IntegratorType::light;
    settings.uniform_hemisphere = type == IntegratorType::hemisphere;
    settings.balance_heuristic = type == IntegratorType::path && integrator.heuristic == MisHeuristic::balance;
    settings.sphere_area = settings.sample_lights && integrator.sphere_lights == SphereLights::area;
    settings.roulette = roulette_number(integrator.roulette);
    settings.roulette_start = integrator.roulette_start;
    settings.roulette_parameters = make_real4(integrator.roulette_probability, 0, 0);
}
} // namespace

AcceleratorType choose_accelerator(const AcceleratorDescription& wanted, std::size_t primitive_count,
                                   std::uint32_t lanes)
{
    if (wanted.type) return *wanted.type;
    const std::size_t limit = lanes > 1 ? BRUTE_FORCE_LIMIT_WIDE : BRUTE_FORCE_LIMIT_SCALAR;
    return primitive_count <= limit ? ACCELERATOR_BRUTE_FORCE : ACCELERATOR_LBVH;
}

RenderSettings make_render_settings(const Scene& scene, const Geometry& geometry, AcceleratorType accelerator)
{
    RenderSettings settings{};
    settings.camera = geometry.camera;
    settings.width = static_cast<uint>(scene.film.width);
    settings.height = static_cast<uint>(scene.film.height);
    settings.seed_low = static_cast<uint>(scene.sampler.seed);
    settings.seed_high = static_cast<uint>(scene.sampler.seed >> 32);
    settings.sampler = sampler_number(scene.sampler.type);
    settings.replicates = scene.sampler.replicates;
    settings.filter = filter_number(scene.film.filter);
    settings.filter_parameters = filter_parameters(scene.film);
    set_integrator(settings, scene.integrator, !geometry.lights.empty());
    settings.accelerator = static_cast<uint>(accelerator);
    settings.primitive_count = static_cast<uint>(geometry.primitives.size());
    settings.light_count = static_cast<uint>(geometry.lights.size());
    settings.alias_shift = 32u;
    if (!geometry.light_table.empty())
        settings.alias_shift -= static_cast<uint>(std::countr_zero(geometry.light_table.size()));
    settings.environment_light = NO_INDEX;
    if (!geometry.lights.empty() && geometry.lights.back().type == LIGHT_ENVIRONMENT)
        settings.environment_light = static_cast<uint>(geometry.lights.size() - 1);
    settings.scene_bounds = geometry.bounding_sphere;
    return settings;
}

ErrorEstimate error_estimate_of(const Scene& scene)
{
    switch (scene.sampler.type) {
    case SamplerType::stratified:
        return ErrorEstimate::blocks;
    case SamplerType::sobol:
        return scene.sampler.replicates > 1 ? ErrorEstimate::halves : ErrorEstimate::none;
    case SamplerType::independent:
        break;
    }
    return ErrorEstimate::samples;
}

std::uint64_t wanted_samples(const Scene& scene)
{
    return scene.integrator.type == IntegratorType::normals ? 1 : scene.sampler.samples_per_pixel;
}
} // namespace etendue
