// Probabilities with which sampling picks one of a surface's lobes.
// Options: those of transport/lobe_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_LOBE_CHOICE_FUNCS_CL
#define PRELIGHT_TRANSPORT_LOBE_CHOICE_FUNCS_CL

#include "transport/layer_funcs.cl"

// Probabilities with which sampling picks a lobe; they add up to 1 unless all are 0.
typedef struct LobeChances {
  float diffuse;
  float specular;  // metal and layer, rough or smooth
  float glass;
#ifdef PRELIGHT_TRANSLUCENT
  float through;
#endif
#ifdef PRELIGHT_LAYERS
  float coat;
  float sheen;
#endif
} LobeChances;

PRELIGHT_INLINE float chanceSum(LobeChances c) {
  float sum = c.diffuse + c.specular + c.glass;
#ifdef PRELIGHT_LAYERS
  sum += c.coat + c.sheen;
#endif
#ifdef PRELIGHT_TRANSLUCENT
  return c.through + sum;
#else
  return sum;
#endif
}

#ifdef PRELIGHT_LAYERS
PRELIGHT_INLINE void addLayerChances(Bsdf b, float3 wo, uint lobes, LobeChances* c) {
  const float onCoat = coatCosine(b, wo), left = leftByLayers(b, wo);
  c->diffuse *= left;
  c->specular *= left;
  c->glass *= left;
#ifdef PRELIGHT_TRANSLUCENT
  c->through *= left;
#endif
  c->coat = c->sheen = 0.0f;
  if (wo.z <= 0.0f) return;
  if ((lobes & (b.coatSmooth ? PRELIGHT_LOBE_MIRROR : PRELIGHT_LOBE_COAT)) != 0u && dot(wo, b.coatNormal) > 0.0f)
    c->coat = coatAlbedo(b, onCoat);
  if ((lobes & PRELIGHT_LOBE_SHEEN) != 0u) c->sheen = largest(b.sheen) * sheenAlbedo(b, wo.z);
}
#endif

// Returns the probabilities of those among `lobes`, roughly in proportion to how much light from wo they scatter.
PRELIGHT_INLINE LobeChances lobeChances(Bsdf b, float3 wo, uint lobes) {
  const float cosine = wo.z;
  const float passes = passage(b, wo);
  LobeChances c = {0.0f, 0.0f, 0.0f};
#ifdef PRELIGHT_TRANSLUCENT
  const bool through = (lobes & PRELIGHT_LOBE_THROUGH) != 0u && cosine > 0.0f;
  c.through = through ? largest(b.transmitted) * passes : 0.0f;
#endif
  if (cosine > 0.0f) {
    if ((lobes & PRELIGHT_LOBE_DIFFUSE) != 0u) c.diffuse = largest(b.diffuse) * passes;
#if defined(PRELIGHT_GLOSSY) || defined(PRELIGHT_MIRROR)
    if ((lobes & (b.smooth ? PRELIGHT_LOBE_MIRROR : PRELIGHT_LOBE_GLOSSY)) != 0u) c.specular = largest(specularAlbedo(b, wo));
#endif
  }
#ifdef PRELIGHT_GLASS
  if ((lobes & PRELIGHT_LOBES_GLASS) != 0u) c.glass = b.glass;
#endif
#ifdef PRELIGHT_LAYERS
  addLayerChances(b, wo, lobes, &c);
#endif
  const float sum = chanceSum(c);
  if (sum > 0.0f) {
    c.diffuse /= sum;
    c.specular /= sum;
    c.glass /= sum;
#ifdef PRELIGHT_TRANSLUCENT
    c.through /= sum;
#endif
#ifdef PRELIGHT_LAYERS
    c.coat /= sum;
    c.sheen /= sum;
#endif
  }
  return c;
}

// Returns true when a random number in [0,1) picks the lobe below the surface. Subtracts that lobe's probability from
// it; the number is then negative if the lobe was picked, and otherwise decides among the other lobes.
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
