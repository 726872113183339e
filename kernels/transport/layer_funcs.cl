// Layers over the rest of a material: sheen (KHR_materials_sheen) and over that a clear coat (KHR_materials_clearcoat).
// Lobes below are scaled by the share of light that the layers leave along the eye's direction. Directions are in the
// frame of the shading normal (z).
// [1] Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
#ifndef PRELIGHT_TRANSPORT_LAYER_FUNCS_CL
#define PRELIGHT_TRANSPORT_LAYER_FUNCS_CL

#include "transport/microfacet_funcs.cl"

#ifdef PRELIGHT_LAYERS
#define PRELIGHT_COAT_F0 0.04f

PRELIGHT_INLINE float coatReflectance(float cosine) { return PRELIGHT_COAT_F0 + (1.0f - PRELIGHT_COAT_F0) * schlickRise(cosine); }

// Returns the coat's albedo for a direction of this cosine with its normal.
PRELIGHT_INLINE float coatAlbedo(Bsdf b, float cosine) {
  if (b.coatSmooth) return b.coat * coatReflectance(cosine);
  const float2 first = lobeAlbedo(b.albedos, cosine, b.coatRoughness).xy;
  return b.coat * (PRELIGHT_COAT_F0 * first.x + first.y);
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

// Returns the fit of Lambda, [1] eq. 3.
PRELIGHT_INLINE float sheenFit(float x, float alpha) {
  const float k = (1.0f - alpha) * (1.0f - alpha);
  const float a = mix(21.5473f, 25.3245f, k), b = mix(3.82987f, 3.32435f, k), c = mix(0.19823f, 0.16801f, k);
  const float d = mix(-1.97760f, -1.27393f, k), e = mix(-4.32054f, -4.85967f, k);
  return a / (1.0f + b * pow(x, c)) + d * x + e;
}

PRELIGHT_INLINE float sheenLambda(float cosine, float alpha) {
  const float x = clamp(cosine, 1e-4f, 1.0f);
  return x < 0.5f ? exp(sheenFit(x, alpha)) : exp(2.0f * sheenFit(0.5f, alpha) - sheenFit(fmax(1.0f - x, 1e-6f), alpha));
}

// Evaluates a sheen of colour 1, times the cosine of wi.
PRELIGHT_INLINE float evalSheen(Bsdf b, float3 wo, float3 wi) {
  const float3 h = normalize(wo + wi);
  const float inverse = 1.0f / b.sheenAlpha;
  const float density = (2.0f + inverse) * pow(fmax(1.0f - h.z * h.z, 0.0f), 0.5f * inverse) * (0.5f * PRELIGHT_INVERSE_PI);
  return density / ((1.0f + sheenLambda(wo.z, b.sheenAlpha) + sheenLambda(wi.z, b.sheenAlpha)) * 4.0f * fmax(wo.z, 1e-6f));
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
