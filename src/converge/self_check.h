// The bench measures what is known: the error of a furnace with Russian roulette, in absolute numbers.
#pragma once

#include "render/renderer.h"

#include <functional>
#include <string>
#include <vector>

namespace etendue
{
// One known number and what was measured.
struct SelfCheckResult {
    std::string name;
    double expected = 0.0, found = 0.0, standard_error = 0.0;
    bool passed = false;

    double z() const { return (found - expected) / standard_error; }
};

// In a closed room whose walls emit 1 and reflect a, with every path surviving with probability q at each vertex, a
// sample is X = 1 + (a / q) X' with probability q and 1 otherwise.
double furnace_variance(double albedo, double survival);

// Variance times rays per sample: var / (1 - q), since a path has 1 / (1 - q) rays on average.
double furnace_cost(double albedo, double survival);

// Render the room with albedo 1/2: MSE(N) = 0.363636 / N for q = 0.8, and the cost for q = 0.5, 0.8 and 0.95 (4.0, 1.82
// and 1.43). Ends early, with fewer results, when it is stopped. Throws DeviceError and BuildError.
std::vector<SelfCheckResult> run_self_check(const RenderOptions& options, const std::function<bool()>& stop);

bool passed(const std::vector<SelfCheckResult>& results);
} // namespace etendue
