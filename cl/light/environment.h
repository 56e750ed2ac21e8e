/* Light from infinitely far away, the same from everywhere; sampled uniformly over the sphere. */
#pragma once
#include "light/light_sample.h"

STATIC LightSample environment_light_sample(Color radiance, Float u, Float v)
{
    LightSample sample;
    sample.wi = uniform_sphere_sample(u, v);
    sample.to_light = sample.wi;
    sample.t_max = (Float)(INFINITE);
    sample.primitive = (Uint)(NO_INDEX);
    sample.radiance = radiance;
    sample.pdf = uniform_sphere_pdf();
    return sample;
}

STATIC Float environment_light_pdf(void)
{
    return uniform_sphere_pdf();
}
