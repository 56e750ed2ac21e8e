/* Elementary functions of our own: equal bits at every width and on every device, and faster than PoCL's. */
#pragma once
#include "math/numerics.h"

#define PI 3.14159265358979323846
#define INV_PI 0.31830988618379067154
#define INV_TWO_PI 0.15915494309189533577
#define INV_FOUR_PI 0.07957747154594766788

/* sine and cosine of 2 pi t for t in [-2, 2]: reduce to an eighth of a turn, exactly, then minimax polynomials.
 * Absolute error below 1.2e-7 in float (2 u). */
STATIC void sin_cos_two_pi(Float t, Float* sine, Float* cosine)
{
    /* Subtract the nearest quarter turn: quarters = round(4 t), rest in [-1/8, 1/8] turns, without rounding. */
    Int quarters = to_int(fma(t, (Float)(4.0), copy_sign((Float)(0.5), t)));
    Float rest = fma(to_float(quarters), (Float)(-0.25), t);
    /* Evaluate both polynomials in the angle x = 2 pi rest. */
    Float x = rest * (2.0 * PI);
    Float z = x * x;
#if REAL_IS_DOUBLE
    Float s = sin(x), c = cos(x);
#else
    Float s =
        fma(x * z, fma(z, fma(z, (Float)(-1.9515295891e-4), (Float)(8.3321608736e-3)), (Float)(-1.6666654611e-1)), x);
    Float c = fma(
        z * z,
        fma(z, fma(z, (Float)(2.443315711809948e-5), (Float)(-1.388731625493765e-3)), (Float)(4.166664568298827e-2)),
        fma(z, (Float)(-0.5), (Float)(1.0)));
#endif
    /* Turn the result by the quarters taken off. */
    Mask odd = (quarters & 1) != 0;
    Float sin_turned = odd ? c : s;
    Float cos_turned = odd ? s : c;
    *sine = (quarters & 2) != 0 ? -sin_turned : sin_turned;
    *cosine = ((quarters + 1) & 2) != 0 ? -cos_turned : cos_turned;
}

/* natural logarithm of a normal x > 0: x = 2^e m with m in [sqrt(1/2), sqrt(2)), polynomial of Cephes' logf.
 * Relative error below 2 u away from x = 1, absolute below u near it. */
STATIC Float log_of(Float x)
{
#if REAL_IS_DOUBLE
    return log(x);
#else
    /* Split off the exponent so that the mantissa lies around 1. */
    Int bits = int_bits(x);
    Int exponent = ((bits - 0x3f3504f3) >> 23);
    Float m = from_bits(bits - (exponent << 23)) - 1.0;
    Float z = m * m;
    Float e = to_float(exponent);
    /* Evaluate log(1 + m) = m - m^2/2 + m^3 p(m). */
    Float p = fma(m, (Float)(7.0376836292e-2), (Float)(-1.1514610310e-1));
    p = fma(p, m, (Float)(1.1676998740e-1));
    p = fma(p, m, (Float)(-1.2420140846e-1));
    p = fma(p, m, (Float)(1.4249322787e-1));
    p = fma(p, m, (Float)(-1.6668057665e-1));
    p = fma(p, m, (Float)(2.0000714765e-1));
    p = fma(p, m, (Float)(-2.4999993993e-1));
    p = fma(p, m, (Float)(3.3333331174e-1));
    Float tail = p * m * z;
    /* Add e log 2 in two parts, small ones first. */
    tail = fma(e, (Float)(-2.12194440e-4), tail);
    tail = fma(z, (Float)(-0.5), tail);
    return fma(e, (Float)(0.693359375), m + tail);
#endif
}
