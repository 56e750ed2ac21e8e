// Whether a device computes as the kernels need it: strict floating point, which a driver may give up in silence.
#pragma once

#include "compute/program.h"

#include <string>
#include <vector>

namespace etendue
{
// Asks a compiler to give up what the canary looks for: an experiment, whose pictures may be wrong.
inline constexpr const char* FAST_MATH_OPTION = "-cl-fast-relaxed-math";

struct CanaryFinding {
    std::string name; // "contraction"
    bool passed = false;
    std::string detail; // "0 of 256 products are contracted"
};

struct CanaryReport {
    bool passed = false; // every finding
    std::vector<CanaryFinding> findings;
    bool from_cache = false;
    double seconds = 0.0;

    // The findings that did not pass, as one sentence; "" when all did.
    std::string complaint() const;
};

// Run canary.cl with these options (those of the kernels that matter), or read what it found the last time: the verdict
// is kept in the cache's folder under a key of device, driver, options and source. Throws BuildError, DeviceError.
CanaryReport run_canary(const Device& device, const std::string& options, const KernelCache& cache);
} // namespace etendue
