// Smooth glass: reflection and refraction (docs/reference.md), as radiance follows them.
#ifndef PRELIGHT_TRANSPORT_GLASS_FUNCS_CL
#define PRELIGHT_TRANSPORT_GLASS_FUNCS_CL

#include "transport/interaction_funcs.cl"
#include "transport/lobe_funcs.cl"

// The way that light takes at glass.
typedef struct GlassSample {
  float3 direction;
  float3 weight;
  float eta2;       // square of the relative index of refraction that radiance has passed; 1 of importance
  float reflected;  // share that is reflected, by the normal that decided
  bool passes;
} GlassSample;

// Share of unpolarised light that a dielectric reflects; eta = ior beyond / ior here. cosine in (0,1].
PRELIGHT_INLINE float fresnelDielectric(float cosine, float eta) {
  const float sine2 = (1.0f - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0f) return 1.0f;
  const float beyondCosine = sqrt(1.0f - sine2);
  const float s = (cosine - eta * beyondCosine) / (cosine + eta * beyondCosine);
  const float p = (eta * cosine - beyondCosine) / (eta * cosine + beyondCosine);
  return 0.5f * (s * s + p * p);
}

// Ratio of the ior beyond to that here.
PRELIGHT_INLINE float relativeIor(Bsdf b, bool solid, bool front) { return solid && !front ? 1.0f / b.ior : b.ior; }

// Share of the light that is reflected; all of it where nothing can pass.
PRELIGHT_INLINE float glassReflectance(Bsdf b, bool solid, bool front, float cosine) {
  const float reflected = b.ior == 0.0f ? 1.0f : fresnelDielectric(cosine, relativeIor(b, solid, front));
  return solid ? reflected : 2.0f * reflected / (1.0f + reflected);  // all the reflections between two faces
}

PRELIGHT_INLINE float glassCosine(float3 wo, float3 n) { return fmin(fmax(dot(wo, n), 1e-6f), 1.0f); }

PRELIGHT_INLINE float3 mirrorAbout(float3 wo, float3 n) { return 2.0f * dot(wo, n) * n - wo; }

// Where light that came from wo goes on beyond the surface. `n` is on wo's side; not all is reflected.
PRELIGHT_INLINE float3 passGlass(Bsdf b, bool solid, bool front, float3 wo, float3 n) {
  if (!solid) return -wo;
  const float cosine = glassCosine(wo, n);
  const float eta = relativeIor(b, solid, front);
  const float inside = sqrt(fmax(1.0f - (1.0f - cosine * cosine) / (eta * eta), 0.0f));
  return normalize((cosine / eta - inside) * n - wo / eta);
}

// Reflected or refracted, in proportion to Fresnel's share: `chance` is in [0,1). `n` is on i.wo's side.
PRELIGHT_INLINE GlassSample sampleGlassAbout(Interaction i, Bsdf b, float3 n, float chance) {
  const bool solid = isSolid(i);
  const float eta = relativeIor(b, solid, i.front);
  GlassSample g;
  g.reflected = glassReflectance(b, solid, i.front, glassCosine(i.wo, n));
  g.passes = chance >= g.reflected;
  g.weight = g.passes ? b.tint : (float3)(1.0f);
  g.eta2 = g.passes && solid ? eta * eta : 1.0f;
  g.direction = g.passes ? passGlass(b, solid, i.front, i.wo, n) : mirrorAbout(i.wo, n);
  return g;
}

// Where the shading normal would send light to the wrong side, the triangle's own does not.
PRELIGHT_INLINE GlassSample sampleGlassRadiance(Interaction i, Bsdf b, float chance) {
  const GlassSample g = sampleGlassAbout(i, b, i.woLocal.z > 0.0f ? i.frame.z : i.geometric, chance);
  if ((dot(g.direction, i.geometric) < 0.0f) == g.passes) return g;
  return sampleGlassAbout(i, b, i.geometric, chance);
}

#endif
