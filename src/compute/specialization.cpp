// Features as macros, from the lists of cl/shared/features.h.
#include "compute/specialization.h"

#include <fmt/format.h>

namespace etendue
{
const std::vector<FeatureDescription>& feature_descriptions()
{
#define DESCRIBE_FEATURE(NAME, name, text) {"HAS_" #NAME, #name, text},
    static const std::vector<FeatureDescription> descriptions{
        BSDF_LIST(DESCRIBE_FEATURE) LIGHT_LIST(DESCRIBE_FEATURE) SHAPE_LIST(DESCRIBE_FEATURE)
            CAMERA_LIST(DESCRIBE_FEATURE) ACCELERATOR_LIST(DESCRIBE_FEATURE) SAMPLER_LIST(DESCRIBE_FEATURE)
                OPTION_LIST(DESCRIBE_FEATURE)};
#undef DESCRIBE_FEATURE
    return descriptions;
}

Specialization Specialization::everything(std::uint32_t lanes, std::uint32_t stack_size)
{
    static_assert(static_cast<std::uint32_t>(Feature::COUNT) < 32);
    return {(1u << static_cast<std::uint32_t>(Feature::COUNT)) - 1u, lanes, stack_size, Precision::single};
}

void Specialization::set(Feature f, bool on)
{
    const std::uint32_t bit = 1u << static_cast<std::uint32_t>(f);
    features = on ? features | bit : features & ~bit;
}

std::string Specialization::build_options() const
{
    std::string options;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Feature::COUNT); ++i)
        options += fmt::format("-D{}={} ", feature_descriptions()[i].macro, (features >> i) & 1u);
    options += fmt::format("-DLANES={} -DSTACK_SIZE={}", lanes, stack_size);
    return precision == Precision::fp64 ? options + " -DREAL_IS_DOUBLE=1" : options;
}
} // namespace etendue
