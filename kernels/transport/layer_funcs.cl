// Layers over the rest of a material: sheen (KHR_materials_sheen) and over that a clear coat (KHR_materials_clearcoat).
// Lobes below are scaled by the share of light that the layers leave along the eye's direction. Directions are in the
// frame of the shading normal (z).
#ifndef PRELIGHT_TRANSPORT_LAYER_FUNCS_CL
#define PRELIGHT_TRANSPORT_LAYER_FUNCS_CL

#include "transport/microfacet_funcs.cl"

#ifdef PRELIGHT_LAYERS
// Returns the coat's albedo for a direction of this cosine with its normal.
PRELIGHT_INLINE float coatAlbedo(Bsdf b, float cosine) {
  return albedoOfCoat(b.albedos, b.coat, b.coatRoughness, b.coatSmooth, cosine);
}

PRELIGHT_INLINE float sheenAlbedo(Bsdf b, float cosine) { return lobeAlbedo(b.albedos, cosine, b.sheenRoughness).z; }

PRELIGHT_INLINE float coatCosine(Bsdf b, float3 w) { return fabs(dot(w, b.coatNormal)); }

// Returns the share that both layers leave of light along a direction, given its cosines with the coat's normal and the
// shading normal.
PRELIGHT_INLINE float belowLayers(Bsdf b, float onCoat, float onSheen) {
  return (1.0f - coatAlbedo(b, onCoat)) * (1.0f - largest(b.sheen) * sheenAlbedo(b, onSheen));
}

PRELIGHT_INLINE Frame coatFrame(Bsdf b) { return frameAround(b.coatNormal); }

// Evaluates the coat, times the cosine of wi. The cosine with the coat's own normal is that of the direction from
// which light comes: wi, or with `importance` wo.
PRELIGHT_INLINE float evalCoat(Bsdf b, float3 wo, float3 wi, bool importance) {
  const Frame frame = coatFrame(b);
  const float3 from = toFrame(frame, wo), to = toFrame(frame, wi);
  if (b.coatSmooth || !(b.coat > 0.0f) || from.z <= 0.0f || to.z <= 0.0f) return 0.0f;
  const float3 h = normalize(from + to);
  const float bent = importance ? from.z * wi.z / fmax(wo.z * to.z, 1e-9f) : 1.0f;
  return b.coat * coatReflectance(dot(from, h)) * evalMicrofacet(from, to, h, b.coatRoughness * b.coatRoughness) * bent;
}

PRELIGHT_INLINE float pdfCoat(Bsdf b, float3 wo, float3 wi) {
  const Frame frame = coatFrame(b);
  const float3 from = toFrame(frame, wo), to = toFrame(frame, wi);
  if (b.coatSmooth || from.z <= 0.0f || to.z <= 0.0f) return 0.0f;
  return pdfMicrofacet(from, normalize(from + to), b.coatRoughness * b.coatRoughness);
}

PRELIGHT_INLINE float3 sampleCoat(Bsdf b, float2 u, float3 wo) {
  const Frame frame = coatFrame(b);
  return fromFrame(frame, sampleMicrofacet(u, toFrame(frame, wo), b.coatRoughness * b.coatRoughness));
}

// Evaluates a sheen of colour 1, times the cosine of wi.
PRELIGHT_INLINE float evalSheen(Bsdf b, float3 wo, float3 wi) {
  return sheenLobe(wo.z, wi.z, normalize(wo + wi).z, b.sheenAlpha);
}

// Evaluates both layers from wo to wi, both above the surface, times the cosine of wi. `eye`: the one of the two
// directions to which light goes.
PRELIGHT_INLINE float3 evalLayers(Bsdf b, float3 wo, float3 wi, float3 eye) {
  float3 sum = (float3)(evalCoat(b, wo, wi, all(isequal(eye, wi))));
  if (largest(b.sheen) > 0.0f) sum += b.sheen * (evalSheen(b, wo, wi) * (1.0f - coatAlbedo(b, coatCosine(b, eye))));
  return sum;
}
#endif

// Returns the share of light along a direction that the layers leave to the lobes below them.
PRELIGHT_INLINE float leftByLayers(Bsdf b, float3 eye) {
#ifdef PRELIGHT_LAYERS
  return belowLayers(b, coatCosine(b, eye), fabs(eye.z));
#else
  return 1.0f;
#endif
}

#endif
