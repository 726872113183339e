// What a surface is made of, as light meets it: the lobes of its scattering, and the chances with which they are drawn.
// docs/reference.md states the model.
// Options: PRELIGHT_GLOSSY (some surface reflects with roughness), PRELIGHT_MIRROR (some without), PRELIGHT_GLASS,
// PRELIGHT_TRANSLUCENT (some lets light through diffusely).
#ifndef PRELIGHT_TRANSPORT_LOBE_FUNCS_CL
#define PRELIGHT_TRANSPORT_LOBE_FUNCS_CL

#include "core/inline.h"
#include "core/vector_funcs.cl"

#define PRELIGHT_SMOOTH_BELOW 0.05f    // roughness; the lobe of a rougher one is still resolved by float32
#define PRELIGHT_NARROW_ALPHA 0.0625f  // roughness 0.25: host/photon/caustic_casters.h says the same
#define PRELIGHT_INVERSE_PI 0.318309886f

// What a path carries: radiance backwards from the eye or a receiver, importance (the power of a photon) forwards from a light.
#define PRELIGHT_RADIANCE 0u
#define PRELIGHT_IMPORTANCE 1u

// Sets of lobes. A sample comes from one.
#define PRELIGHT_LOBE_DIFFUSE 1u
#define PRELIGHT_LOBE_THROUGH 2u             // diffuse as well, out of the other side
#define PRELIGHT_LOBE_GLOSSY 4u              // metal and layer where they are rough
#define PRELIGHT_LOBE_MIRROR 8u              // metal and layer where they are smooth
#define PRELIGHT_LOBE_GLASS_REFLECTION 16u
#define PRELIGHT_LOBE_GLASS_TRANSMISSION 32u
#define PRELIGHT_LOBES_DIFFUSE (PRELIGHT_LOBE_DIFFUSE | PRELIGHT_LOBE_THROUGH)
#define PRELIGHT_LOBES_GLASS (PRELIGHT_LOBE_GLASS_REFLECTION | PRELIGHT_LOBE_GLASS_TRANSMISSION)
#define PRELIGHT_LOBES_SPECULAR (PRELIGHT_LOBE_MIRROR | PRELIGHT_LOBES_GLASS)  // they scatter to single directions
#define PRELIGHT_LOBES_ALL (PRELIGHT_LOBES_DIFFUSE | PRELIGHT_LOBE_GLOSSY | PRELIGHT_LOBES_SPECULAR)

typedef struct Bsdf {
  float3 diffuse;  // albedo
#ifdef PRELIGHT_TRANSLUCENT
  float3 transmitted;  // the same for light that leaves on the other side
#endif
  float3 metal;    // reflectance
  float3 f0;       // of the dielectric's reflecting layer
  float f90;
  float layer;  // share of the surface that the layer covers
  float glass;  // share that is glass
  float3 tint;  // of what passes through the glass
  float ior;    // 0: infinite
  float alpha;  // width of the GGX lobe, roughness squared
  bool smooth;  // metal and layer are mirrors
} Bsdf;

// Probabilities with which sampling picks a lobe; they add up to 1 unless all are 0.
typedef struct LobeChances {
  float diffuse;
  float specular;  // of metal and layer, rough or smooth
  float glass;
#ifdef PRELIGHT_TRANSLUCENT
  float through;
#endif
} LobeChances;

// Schlick 1994: how far reflectance has risen from that along the normal to that at grazing angles.
PRELIGHT_INLINE float schlickRise(float cosine) {
  const float k = clamp(1.0f - cosine, 0.0f, 1.0f);
  const float k2 = k * k;
  return k2 * k2 * k;
}

// Reflectance of the layer.
PRELIGHT_INLINE float3 schlick(Bsdf b, float cosine) { return b.f0 + (b.f90 - b.f0) * schlickRise(cosine); }

// Its mean over directions, weighted by the cosine: that of the rise is 1/21.
PRELIGHT_INLINE float3 meanLayer(Bsdf b) { return b.f0 + (b.f90 - b.f0) * (1.0f / 21.0f); }

// Whether the body scatters any light, to either side.
PRELIGHT_INLINE bool isDiffuse(Bsdf b) {
#ifdef PRELIGHT_TRANSLUCENT
  if (largest(b.transmitted) > 0.0f) return true;
#endif
  return largest(b.diffuse) > 0.0f;
}

PRELIGHT_INLINE bool isGlossy(Bsdf b) {
#ifdef PRELIGHT_GLOSSY
  return !b.smooth && largest(b.metal) + b.layer > 0.0f;
#else
  return false;
#endif
}

// Mirrors, and lobes that show what is there: light that they gather is followed from its source, light of wider ones is
// found by chance.
PRELIGHT_INLINE bool isNarrow(Bsdf b) { return b.smooth || b.alpha <= PRELIGHT_NARROW_ALPHA; }

// The lobes that make caustics.
PRELIGHT_INLINE uint narrowLobes(Bsdf b) { return PRELIGHT_LOBES_SPECULAR | (isNarrow(b) ? PRELIGHT_LOBE_GLOSSY : 0u); }

// What metal and layer reflect of light from a direction of this cosine, over all directions.
PRELIGHT_INLINE float3 specularReflectance(Bsdf b, float cosine) { return b.metal + b.layer * schlick(b, cosine); }

PRELIGHT_INLINE float chanceSum(LobeChances c) {
  const float sum = c.diffuse + c.specular + c.glass;
#ifdef PRELIGHT_TRANSLUCENT
  return c.through + sum;
#else
  return sum;
#endif
}

// Chances of those among `lobes`, roughly in proportion to what they scatter of light from a direction of this cosine.
PRELIGHT_INLINE LobeChances lobeChances(Bsdf b, float cosine, uint lobes) {
  const float3 layer = schlick(b, cosine);
  LobeChances c = {0.0f, 0.0f, 0.0f};
#ifdef PRELIGHT_TRANSLUCENT
  const bool through = (lobes & PRELIGHT_LOBE_THROUGH) != 0u && cosine > 0.0f;
  c.through = through ? largest(b.transmitted) * (1.0f - largest(layer)) : 0.0f;
#endif
  if (cosine > 0.0f) {
    if ((lobes & PRELIGHT_LOBE_DIFFUSE) != 0u) c.diffuse = largest(b.diffuse) * (1.0f - largest(layer));
#if defined(PRELIGHT_GLOSSY) || defined(PRELIGHT_MIRROR)
    if ((lobes & (b.smooth ? PRELIGHT_LOBE_MIRROR : PRELIGHT_LOBE_GLOSSY)) != 0u) c.specular = largest(b.metal + b.layer * layer);
#endif
  }
#ifdef PRELIGHT_GLASS
  if ((lobes & PRELIGHT_LOBES_GLASS) != 0u) c.glass = b.glass;
#endif
  const float sum = chanceSum(c);
  if (sum > 0.0f) {
    c.diffuse /= sum;
    c.specular /= sum;
    c.glass /= sum;
#ifdef PRELIGHT_TRANSLUCENT
    c.through /= sum;
#endif
  }
  return c;
}

// Whether a chance in [0,1) picks the lobe below the surface. What is left of the chance decides among the others: it is
// negative then.
PRELIGHT_INLINE bool picksThrough(LobeChances c, float* chance) {
#ifdef PRELIGHT_TRANSLUCENT
  const bool picks = *chance < c.through;
  *chance -= c.through;
  return picks;
#else
  return false;
#endif
}

#endif
