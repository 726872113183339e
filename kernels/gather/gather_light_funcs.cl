// Lamps that a gathering ray finds behind lobes through which no caustic photons are followed. They are sampled where
// such a lobe is met and also found by chance, and the two strategies are combined by multiple importance sampling.
// Options: those of transport/scene_funcs.cl, PRELIGHT_ASKS_LIGHTS (some lobe is rough, and there are lights).
#ifndef PRELIGHT_GATHER_LIGHT_FUNCS_CL
#define PRELIGHT_GATHER_LIGHT_FUNCS_CL

#include "shared/gather_types.h"
#include "transport/mis_funcs.cl"
#include "transport/scene_funcs.cl"

// Returns the lobes behind which lamps count.
PRELIGHT_INLINE uint countedLobes(Bsdf b, uint flags) {
  const uint lobes = PRELIGHT_LOBES_ALL & ~PRELIGHT_LOBES_DIFFUSE;
  return (flags & PRELIGHT_GATHER_WIDENED) != 0u ? lobes : lobes & ~narrowLobes(b);
}

// Returns true when lamps in a direction of this cosine are sampled for a lobe rather than left to chance. Behind a
// face of solid glass no lamp is visible past the other face. Coat and sheen are evaluated together, so both must
// count.
PRELIGHT_INLINE bool asksFor(Bsdf b, uint lobe, uint flags, float cosine) {
  const uint counted = countedLobes(b, flags);
#ifdef PRELIGHT_LAYERS
  if ((lobe & PRELIGHT_LOBES_LAYERS) != 0u)
    return cosine > 0.0f && (!(b.coat > 0.0f) || b.coatSmooth || (counted & PRELIGHT_LOBE_COAT) != 0u);
#endif
#ifdef PRELIGHT_ROUGH_GLASS
  if (cosine <= 0.0f && b.solid) return false;
#endif
  return (counted & lobe) != 0u;
}

#ifdef PRELIGHT_ASKS_LIGHTS
// Returns about how much the lobes that are not diffuse reflect.
PRELIGHT_INLINE float roughAlbedo(Bsdf b, float3 wo) {
  float albedo = b.glass;
#if defined(PRELIGHT_GLOSSY) || defined(PRELIGHT_MIRROR)
  albedo += largest(specularAlbedo(b, wo));
#endif
#ifdef PRELIGHT_LAYERS
  albedo += b.coat + largest(b.sheen);
#endif
  return albedo;
}

PRELIGHT_INLINE float3 weighedLobe(Bsdf b, LobeChances chances, uint lobe, Scattered f, float3 wo, float3 wi, LightSample light) {
  float density;
  const float3 value = scatteredApart(b, chances, lobe, f, wo, wi, wo, &density);
  return light.punctual ? value : value * misWeight(light.pdf, density);
}

// Returns the radiance of a light sample that the lobes with light sampling reflect along the ray, without occlusion.
PRELIGHT_INLINE float3 reflectLight(Interaction i, Bsdf b, uint flags, LightSample light) {
  const float3 wo = i.woLocal, wi = toFrame(i.frame, light.direction);
  float3 sum = (float3)(0.0f);
  const float geometric = dot(light.direction, i.geometric);
  if (wo.z <= 0.0f || !maySee(b, wi, geometric)) return sum;
  const LobeChances chances = lobeChances(b, wo, PRELIGHT_LOBES_ALL & ~PRELIGHT_LOBES_DIFFUSE);
  const Scattered f = evalLobes(b, wo, wi, isAbove(wi, geometric), wo);
#ifdef PRELIGHT_GLOSSY
  if (!b.smooth && asksFor(b, PRELIGHT_LOBE_GLOSSY, flags, wi.z))
    sum += weighedLobe(b, chances, PRELIGHT_LOBE_GLOSSY, f, wo, wi, light);
#endif
#ifdef PRELIGHT_ROUGH_GLASS
  if (isRoughGlass(b) && asksFor(b, PRELIGHT_LOBE_GLASS_REFLECTION, flags, wi.z))
    sum += weighedLobe(b, chances, PRELIGHT_LOBE_GLASS_REFLECTION, f, wo, wi, light);
#endif
#ifdef PRELIGHT_LAYERS
  if (asksFor(b, PRELIGHT_LOBE_COAT, flags, wi.z)) sum += weighedLobe(b, chances, PRELIGHT_LOBE_COAT, f, wo, wi, light);
#endif
  return sum * light.radiance / light.pdf;
}
#endif

#endif
