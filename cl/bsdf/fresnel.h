/* Fresnel's equations for unpolarised light. */
#pragma once
#include "math/vector.h"

/* Reflectance of a dielectric boundary: cos_i in [0, 1] from the normal on the side of incidence, eta = index beyond /
 * index before. *eta_cos_t gets eta times the cosine of refraction, 0 under total reflection.
 *
 * eta^2 cos_t^2 = (eta^2 - 1) + cos_i^2 cancels near the critical angle, so it is summed with its rounding errors. */
STATIC Float fresnel_dielectric(Float cos_i, Float eta, Float* eta_cos_t)
{
    /* Square without loss: eta^2 = eta2 + eta2_error, cos_i^2 = c2 + c2_error. */
    Float eta2 = eta * eta, eta2_error = fma(eta, eta, -eta2);
    Float c2 = cos_i * cos_i, c2_error = fma(cos_i, cos_i, -c2);
    Float first_error, second_error;
    Float first = two_sum(eta2, (Float)(-1.0), &first_error);
    Float second = two_sum(first, c2, &second_error);
    Float squared = second + (second_error + first_error + (eta2_error + c2_error));
    Float g = sqrt_of(squared);
    *eta_cos_t = g;
    /* Average both polarisations; cos_t = g / eta. */
    Float perpendicular = (cos_i - g) / (cos_i + g);
    Float parallel = (eta2 * cos_i - g) / (eta2 * cos_i + g);
    Float reflectance = 0.5 * (square(perpendicular) + square(parallel));
    return squared > 0.0 ? min_of(reflectance, (Float)(1.0)) : (Float)(1.0);
}
