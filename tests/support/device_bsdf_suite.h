// Tests that every BSDF of BSDF_LIST passes, whatever it is: a new one needs no new test code for them. What is asked
// of it are bsdf_evaluate, bsdf_pdf and bsdf_sample; its parameters, their ranges and whether it is a delta lobe come
// from the parameter table of the materials.
//
// Of BSDFs with a density: the weight is f |cos| / pdf; the pdf of a sample is pdf(); the density is the Jacobian of
// the sampling; reciprocity; the pdf integrates to 1; chi-square; albedo by sampling = by quadrature, at most 1; edges.
// Of delta lobes: nothing to evaluate; unit directions; energy; the way back is the same.
#pragma once

#include "compute/device.h"
#include "math/shared.h"
#include "support/device_evaluate.h"

#include <array>
#include <string>
#include <vector>

namespace etendue
{
// A material to test.
struct BsdfCase {
    BsdfType type;
    std::vector<float> parameters;
    std::string name; // "dielectric 1.5 1 1 1"
};

// Defaults, the corners of the parameters' ranges, and random ones between.
std::vector<BsdfCase> bsdf_cases(BsdfType type);

using Direction = std::array<float, 3>;
using RandomWords = std::array<uint, 4>; // direction in two, lobe in the third

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
    std::vector<Sample> sample(std::vector<Direction> wo, const std::vector<RandomWords>& random) const;

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

// The tests, each for one case.
void check_weights(const Device& device, const BsdfCase& bsdf);
void check_jacobian(const Device& device, const BsdfCase& bsdf);
void check_reciprocity(const Device& device, const BsdfCase& bsdf);
void check_pdf_integral(const Device& device, const BsdfCase& bsdf);
void check_distribution(const Device& device, const BsdfCase& bsdf);
void check_albedo(const Device& device, const BsdfCase& bsdf);
void check_edges(const Device& device, const BsdfCase& bsdf);
void check_delta(const Device& device, const BsdfCase& bsdf);
} // namespace etendue
