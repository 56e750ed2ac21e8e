// The structural features one kernel is built with: from the lists of cl/shared/features.h and nothing else.
#pragma once

#include "math/precision.h"
#include "math/shared.h"

#include <cstdint>
#include <string>
#include <vector>

namespace etendue
{
// HAS_<NAME> of every list, in the order of the lists: the bit numbers of Specialization::features.
enum class Feature : std::uint32_t {
#define FEATURE_ENUMERATOR(NAME, name, text) NAME,
    BSDF_LIST(FEATURE_ENUMERATOR) LIGHT_LIST(FEATURE_ENUMERATOR) SHAPE_LIST(FEATURE_ENUMERATOR)
        CAMERA_LIST(FEATURE_ENUMERATOR) ACCELERATOR_LIST(FEATURE_ENUMERATOR) SAMPLER_LIST(FEATURE_ENUMERATOR)
            OPTION_LIST(FEATURE_ENUMERATOR)
#undef FEATURE_ENUMERATOR
                COUNT
};

struct FeatureDescription {
    const char* macro; // "HAS_DIFFUSE"
    const char* name;  // "diffuse"
    const char* text;
};

// By the number of the Feature.
const std::vector<FeatureDescription>& feature_descriptions();

struct Specialization {
    std::uint32_t features = 0; // bit i: Feature i
    std::uint32_t lanes = 1;
    std::uint32_t stack_size = 32;
    Precision precision = Precision::single;

    // The general kernel: every feature, the stack and lanes as given, in single precision.
    static Specialization everything(std::uint32_t lanes, std::uint32_t stack_size);

    bool has(Feature f) const { return (features >> static_cast<std::uint32_t>(f)) & 1u; }
    void set(Feature f, bool on = true);

    // "-DHAS_DIFFUSE=1 ... -DLANES=16 -DSTACK_SIZE=32": every macro, always; with fp64 " -DREAL_IS_DOUBLE=1" too.
    std::string build_options() const;

    bool operator==(const Specialization&) const = default;
};
} // namespace etendue
