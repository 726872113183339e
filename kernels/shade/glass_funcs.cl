// Smooth glass: reflection and refraction (docs/reference.md).
#ifndef PRELIGHT_SHADE_GLASS_FUNCS_CL
#define PRELIGHT_SHADE_GLASS_FUNCS_CL

#include "shade/bsdf_funcs.cl"

// Ratio of the ior beyond to that here.
float relativeIor(Bsdf b, bool solid, bool front) { return solid && !front ? 1.0f / b.ior : b.ior; }

// Share of the light that is reflected; all of it where nothing can pass.
float glassReflectance(Bsdf b, bool solid, bool front, float cosine) {
  const float reflected = b.ior == 0.0f ? 1.0f : fresnelDielectric(cosine, relativeIor(b, solid, front));
  return solid ? reflected : 2.0f * reflected / (1.0f + reflected);  // all the reflections between two faces
}

float glassCosine(float3 wo, float3 n) { return fmin(fmax(dot(wo, n), 1e-6f), 1.0f); }

// Reflected or refracted, in proportion to Fresnel's share: `chance` is in [0,1). `n` is on wo's side.
float3 throughGlass(Bsdf b, bool solid, bool front, float3 wo, float3 n, float chance, float3* weight, bool* passes,
                    float* relativeIor2) {
  const float cosine = glassCosine(wo, n);
  const float eta = relativeIor(b, solid, front);
  *passes = chance >= glassReflectance(b, solid, front, cosine);
  *relativeIor2 = 1.0f;
  *weight = (float3)(1.0f);
  if (!*passes) return 2.0f * dot(wo, n) * n - wo;
  *weight = b.tint;
  if (!solid) return -wo;
  *relativeIor2 = eta * eta;
  const float inside = sqrt(fmax(1.0f - (1.0f - cosine * cosine) / (eta * eta), 0.0f));
  return normalize((cosine / eta - inside) * n - wo / eta);
}

#endif
