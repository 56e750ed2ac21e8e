// Trees and the rays through them: builders, traversal against testing every primitive, closed meshes, origins on
// surfaces.
#pragma once

#include "check/check.h"

#include <string>
#include <vector>

namespace etendue
{
std::vector<Check> bvh_checks();

// Parts of bvh_checks() that other groups ask for too, under a name of their own.

// The radix sort is std::stable_sort.
CheckResult check_sort(const CheckContext& context, const std::string& name);
// The kernels build the host's tree, climbing and level by level.
CheckResult check_device_tree(const CheckContext& context, const std::string& name);
// R1: closed meshes at three places, so many rays in all; the results' names begin with `name`.
std::vector<CheckResult> check_watertight(const CheckContext& context, const std::string& name, double rays);
// Rays that leave surfaces: R3 and R4.
std::vector<Check> offset_checks();
} // namespace etendue
