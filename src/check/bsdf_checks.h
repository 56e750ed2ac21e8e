// What a BSDF of any kind has to satisfy: a new line of BSDF_LIST is checked without a new line here.
//
// Of BSDFs with a density: the weight is f |cos| / pdf; the pdf of a sample is pdf(); the density is the Jacobian of
// the sampling; reciprocity; the pdf integrates to 1; chi-square; albedo by sampling = by quadrature, at most 1; edges.
// Of delta lobes: nothing to evaluate; unit directions; energy; the way back is the same; edges.
#pragma once

#include "check/check.h"

#include <vector>

namespace etendue
{
std::vector<Check> bsdf_checks();

// Of bsdf/fresnel.h; bsdf_checks() has them too.
std::vector<Check> fresnel_checks();
} // namespace etendue
