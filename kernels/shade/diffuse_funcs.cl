// Radiance that a surface scatters diffusely of known irradiance.
#ifndef PRELIGHT_SHADE_DIFFUSE_FUNCS_CL
#define PRELIGHT_SHADE_DIFFUSE_FUNCS_CL

#include "shade/bsdf_funcs.cl"

// W/(m2 sr) towards a direction of this cosine. evaluateBsdf's diffuse lobe with the layer's passage averaged over the
// directions that the light comes from: the cosine-weighted mean of Schlick's rise is 1/21.
float3 reflectIrradiance(Bsdf b, float cosine, float3 irradiance) {
  const float3 mean = b.f0 + (b.f90 - b.f0) * (1.0f / 21.0f);
  return b.diffuse * irradiance * (PRELIGHT_INVERSE_PI * (1.0f - largest(schlick(b, cosine))) * (1.0f - largest(mean)));
}

#ifdef PRELIGHT_TRANSLUCENT
// The same of what comes through from the other side, where the irradiance is `irradiance`.
float3 transmitIrradiance(Bsdf b, float cosine, float3 irradiance) {
  b.diffuse = b.transmitted;
  return reflectIrradiance(b, cosine, irradiance);
}
#endif

#endif
