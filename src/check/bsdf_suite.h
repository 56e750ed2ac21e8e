// BSDFs on a device, whatever they are: what is asked of one are bsdf_evaluate, bsdf_pdf, bsdf_sample and bsdf_invert;
// its parameters, their ranges and whether it is a delta lobe come from the parameter table of the materials.
#pragma once

#include "check/device_functions.h"
#include "check/direction.h"
#include "check/random_words.h"
#include "compute/device.h"
#include "math/shared.h"

#include <array>
#include <string>
#include <vector>

namespace etendue
{
// A material to check.
struct BsdfCase {
    BsdfType type;
    std::vector<float> parameters;
    std::string name; // "dielectric 1.5 1 1 1"
};

// Defaults, the corners of the parameters' ranges, and random ones between.
std::vector<BsdfCase> bsdf_cases(BsdfType type);

// The unit vector of this cosine and azimuth.
Direction direction(double z, double phi);

// Midpoints of a grid of equal solid angles, in cosine and azimuth, over the whole sphere.
std::vector<Direction> sphere_grid(std::size_t rows, std::size_t columns);

// Unit directions on both sides, cosines 1, .9, .5, .1, .01, .001.
std::vector<Direction> standard_directions();

// One BSDF on a device, in single precision, all directions in the local frame.
class DeviceBsdf
{
public:
    DeviceBsdf(const Device& device, const BsdfCase& bsdf, std::uint32_t lanes = 0)
        : device_(device), bsdf_(bsdf), lanes_(lanes)
    {
    }

    struct Evaluation {
        std::vector<std::array<float, 3>> f;
        std::vector<float> pdf;
    };
    // Both lists have one length, or wo is one direction for all.
    Evaluation evaluate(std::vector<Direction> wo, const std::vector<Direction>& wi) const;

    struct Sample {
        Direction wi;
        std::array<float, 3> weight;
        float pdf;
        bool delta;
        float radiance_scale;
    };
    // The direction takes two words of the random numbers, the choice of a lobe the third.
    std::vector<Sample> sample(std::vector<Direction> wo, const std::vector<RandomWords>& random) const;

    // The two words' numbers that give each wi, computed in double precision, which the device must have; -1 for none.
    std::vector<std::array<double, 2>> invert_in_double(const Direction& wo, const std::vector<Direction>& wi) const;

private:
    const Device& device_;
    const BsdfCase& bsdf_;
    std::uint32_t lanes_;
};

// Several materials in the lanes of one pack, by index into `cases`: words of every output of sampling, then of
// evaluation towards wi.
std::vector<std::vector<std::uint32_t>>
sample_and_evaluate(const Device& device, const std::vector<BsdfCase>& cases, const std::vector<uint>& which,
                    const std::vector<Direction>& wo, const std::vector<Direction>& wi,
                    const std::vector<RandomWords>& random, std::uint32_t lanes);
} // namespace etendue
