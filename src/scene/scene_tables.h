// The tables of the native scene format. A material's is in material_parser.h.
#pragma once

#include "scene/table.h"

#include <vector>

namespace etendue
{
const Table& scene_table(); // the whole file
const Table& camera_table();
const Table& film_table();
const Table& filter_table();
const Table& integrator_table();
const Table& roulette_table();
const Table& sampler_table();
const Table& accelerator_table();
const Table& shape_table();
const Table& light_table();
const Table& emission_table();
const Table& transform_table();
const Table& rotate_table();
const Table& look_at_table();
const Table& environment_table();

// All tables, each before those it refers to.
std::vector<const Table*> all_tables();

inline constexpr int MAX_FILM_SIZE = 65536; // pixels a side

// Limits that keep squares and sums of 64 squares finite in single precision.
inline constexpr double MAX_COORDINATE = 1e15;
inline constexpr double MAX_RADIANCE = 1e15;
} // namespace etendue
