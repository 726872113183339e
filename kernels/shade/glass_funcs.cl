// Smooth glass: reflection and refraction (docs/reference.md).
#ifndef PRELIGHT_SHADE_GLASS_FUNCS_CL
#define PRELIGHT_SHADE_GLASS_FUNCS_CL

#include "shade/vertex_funcs.cl"

// Ratio of the ior beyond to that here.
float relativeIor(Bsdf b, bool solid, bool front) { return solid && !front ? 1.0f / b.ior : b.ior; }

// Share of the light that is reflected; all of it where nothing can pass.
float glassReflectance(Bsdf b, bool solid, bool front, float cosine) {
  const float reflected = b.ior == 0.0f ? 1.0f : fresnelDielectric(cosine, relativeIor(b, solid, front));
  return solid ? reflected : 2.0f * reflected / (1.0f + reflected);  // all the reflections between two faces
}

float glassCosine(float3 wo, float3 n) { return fmin(fmax(dot(wo, n), 1e-6f), 1.0f); }

float3 mirrorAbout(float3 wo, float3 n) { return 2.0f * dot(wo, n) * n - wo; }

// Where light that came from wo goes on beyond the surface. `n` is on wo's side; not all is reflected.
float3 passGlass(Bsdf b, bool solid, bool front, float3 wo, float3 n) {
  if (!solid) return -wo;
  const float cosine = glassCosine(wo, n);
  const float eta = relativeIor(b, solid, front);
  const float inside = sqrt(fmax(1.0f - (1.0f - cosine * cosine) / (eta * eta), 0.0f));
  return normalize((cosine / eta - inside) * n - wo / eta);
}

// Reflected or refracted, in proportion to Fresnel's share: `chance` is in [0,1). `n` is on wo's side.
float3 throughGlass(Bsdf b, bool solid, bool front, float3 wo, float3 n, float chance, float3* weight, bool* passes,
                    float* relativeIor2) {
  const float eta = relativeIor(b, solid, front);
  *passes = chance >= glassReflectance(b, solid, front, glassCosine(wo, n));
  *relativeIor2 = 1.0f;
  *weight = (float3)(1.0f);
  if (!*passes) return mirrorAbout(wo, n);
  *weight = b.tint;
  if (solid) *relativeIor2 = eta * eta;
  return passGlass(b, solid, front, wo, n);
}

// How light leaves the glass of a vertex; woZ: cosine of where it came from with the shading normal. Where that normal would
// send light to the wrong side, the triangle's own does not. `medium` becomes what it runs through then.
float3 leaveGlass(PathScene s, PathVertex v, Bsdf b, float woZ, float chance, float3* weight, float* relativeIor2,
                  uint* medium) {
  const bool solid = (s.materials[v.material].flags & PRELIGHT_SOLID) != 0u;
  const float3 shading = woZ > 0.0f ? v.shading : v.geometric;
  bool passes;
  float3 direction = throughGlass(b, solid, v.front, v.wo, shading, chance, weight, &passes, relativeIor2);
  if ((dot(direction, v.geometric) < 0.0f) != passes)
    direction = throughGlass(b, solid, v.front, v.wo, v.geometric, chance, weight, &passes, relativeIor2);
  if (passes && solid) *medium = v.front ? v.material : PRELIGHT_NO_MEDIUM;
  return direction;
}

#endif
