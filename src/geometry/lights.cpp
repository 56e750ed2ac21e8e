// Powers of lights, and the choice among them.
#include "geometry/lights.h"

#include "geometry/distribution.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace etendue
{
namespace
{
void check_radiance(const Vec3& radiance, const SourceLocation& where)
{
    constexpr double LARGEST = std::numeric_limits<float>::max();
    for (int i = 0; i < 3; ++i)
        if (!(radiance[i] >= 0.0 && radiance[i] <= LARGEST))
            throw SceneError(where, fmt::format("the radiance must be between 0 and {:.3g}, is ({}, {}, {}).", LARGEST,
                                                radiance.x, radiance.y, radiance.z));
}

std::uint32_t append(LightList& list, uint type, uint primitive, uint flags, const Vec3& radiance,
                     double power_per_radiance)
{
    const real4 rounded = make_real4(radiance.x, radiance.y, radiance.z);
    if (rounded.s[0] == 0.0f && rounded.s[1] == 0.0f && rounded.s[2] == 0.0f) return NO_INDEX;
    list.lights.push_back({type, primitive, flags, 0, rounded});
    list.powers.push_back((radiance.x / 3 + radiance.y / 3 + radiance.z / 3) * power_per_radiance);
    return static_cast<std::uint32_t>(list.lights.size() - 1);
}
} // namespace

std::uint32_t add_area_light(LightList& list, const Emission& emission, std::uint32_t primitive, double area,
                             const SourceLocation& where)
{
    check_radiance(emission.radiance, where);
    const double sides = emission.two_sided ? 2.0 : 1.0;
    return append(list, LIGHT_AREA, primitive, emission.two_sided ? LIGHT_TWO_SIDED : 0, emission.radiance,
                  std::numbers::pi * area * sides);
}

void add_environment_light(LightList& list, const EnvironmentDescription& environment, double scene_radius)
{
    check_radiance(environment.radiance, environment.location);
    // Parallel light of each direction goes through the disk of the scene's sphere; integrate over all directions.
    const double disk = std::numbers::pi * scene_radius * scene_radius;
    append(list, LIGHT_ENVIRONMENT, NO_INDEX, 0, environment.radiance, std::numbers::pi * disk);
}

std::vector<AliasBucket> make_light_table(LightList& list)
{
    if (list.lights.empty()) return {};
    // Divide by the largest power first, so that the sum cannot overflow.
    const double largest = *std::max_element(list.powers.begin(), list.powers.end());
    std::vector<double> weights;
    double sum = 0.0;
    for (const double power : list.powers) sum += weights.emplace_back(largest > 0.0 ? power / largest : 1.0);
    const double uniform = UNIFORM_LIGHT_SHARE / static_cast<double>(weights.size());
    for (double& weight : weights) weight = (1.0 - UNIFORM_LIGHT_SHARE) * weight / sum + uniform;

    AliasTable table = make_alias_table(weights);
    for (std::size_t i = 0; i < list.lights.size(); ++i)
        list.lights[i].radiance.s[3] = static_cast<real>(table.probabilities[i]);
    return std::move(table.buckets);
}
} // namespace etendue
