// The lights of a scene and how likely each is chosen.
#pragma once

#include "math/shared.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace etendue
{
// Of every choice of a light, this share is uniform over all of them; the rest goes by power. Power alone knows nothing
// of place: of two rooms lit by 1e8 and by 1e-8, hardly any sample of the second would ever ask its own light.
constexpr double UNIFORM_LIGHT_SHARE = 0.1;

struct LightList {
    std::vector<Light> lights;
    std::vector<double> powers; // of the mean radiance; W per unit of area used
};

// Append a primitive that emits, of this area; return its index, or NO_INDEX where the radiance is zero. Throws
// SceneError at `where`: a radiance that is negative or not a finite float.
std::uint32_t add_area_light(LightList& list, const Emission& emission, std::uint32_t primitive, double area,
                             const SourceLocation& where);

// Append light from everywhere, onto a scene within a sphere of this radius (same unit). Same errors.
void add_environment_light(LightList& list, const EnvironmentDescription& environment, double scene_radius);

// The table that chooses a light; stores in radiance.w of each light the probability that the table gives it.
std::vector<AliasBucket> make_light_table(LightList& list);
} // namespace etendue
