// The rough lobe of GGX microfacets. Light that they do not let out at the first bounce leaves later, in all
// directions. Directions are in the frame of the shading normal (z).
// [1] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (GGX).
// [2] Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2).
// [3] Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
// [4] Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks".
#ifndef PRELIGHT_TRANSPORT_MICROFACET_FUNCS_CL
#define PRELIGHT_TRANSPORT_MICROFACET_FUNCS_CL

#include "transport/lobe_funcs.cl"

// Returns the GGX density of normals ([1] eq. 33), written so that no digits are lost around the normal.
PRELIGHT_INLINE float ggxDensity(float3 h, float alpha) {
  const float a2 = alpha * alpha;
  const float q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 * PRELIGHT_INVERSE_PI / (q * q);
}

// Samples a normal visible from wo, [3], for widths along x and y.
PRELIGHT_INLINE float3 sampleVisibleNormal(float2 u, float3 wo, float2 alphas) {
  const float3 v = normalize((float3)(alphas.x * wo.x, alphas.y * wo.y, wo.z));
  const float z = (1.0f - u.y) * (1.0f + v.z) - v.z;
  const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  const float turn = 2.0f * u.x;
  const float3 h = (float3)(radius * cospi(turn), radius * sinpi(turn), z) + v;
  return normalize((float3)(alphas.x * h.x, alphas.y * h.y, fmax(h.z, 1e-7f)));
}

// Returns the lobe without its reflectance, times the cosine of wi; h: halfway between wo and wi.
PRELIGHT_INLINE float evalMicrofacet(float3 wo, float3 wi, float3 h, float alpha) {
  return ggxDensity(h, alpha) * smithVisibility(wo.z, wi.z, alpha) * wi.z;
}

// Returns the density of the direction to which a visible normal h reflects wo: D G1 / (4 cos), [2] eq. 17.
PRELIGHT_INLINE float pdfMicrofacet(float3 wo, float3 h, float alpha) {
  return 0.5f * ggxDensity(h, alpha) / (wo.z + smithTerm(wo.z, alpha));
}

// Returns the direction in which a sampled normal that is visible from wo reflects it. It may lie below the surface.
PRELIGHT_INLINE float3 mirroredAtVisibleNormal(float2 u, float3 wo, float2 alphas) {
  const float3 h = sampleVisibleNormal(u, wo, alphas);
  return 2.0f * dot(wo, h) * h - wo;
}

PRELIGHT_INLINE float3 sampleMicrofacet(float2 u, float3 wo, float alpha) {
  return mirroredAtVisibleNormal(u, wo, (float2)(alpha));
}

#ifdef PRELIGHT_GLOSSY
// Returns the lobe of metal and layer without its reflectance, times the cosine of wi; h: halfway between wo and wi.
PRELIGHT_INLINE float evalFacets(Bsdf b, float3 wo, float3 wi, float3 h) {
#ifdef PRELIGHT_ANISOTROPY
  const float visibility = 0.5f / (wo.z * anisotropicTerm(wi, b.alphas) + wi.z * anisotropicTerm(wo, b.alphas));
  return anisotropicDensity(h, b.alphas) * visibility * wi.z;
#else
  return evalMicrofacet(wo, wi, h, b.alpha);
#endif
}

PRELIGHT_INLINE float pdfFacets(Bsdf b, float3 wo, float3 h) {
#ifdef PRELIGHT_ANISOTROPY
  return 0.5f * anisotropicDensity(h, b.alphas) / (wo.z + anisotropicTerm(wo, b.alphas));
#else
  return pdfMicrofacet(wo, h, b.alpha);
#endif
}

// Samples the lobe of metal and layer at the first bounce. The direction may lie below the surface.
PRELIGHT_INLINE float3 sampleFacets(Bsdf b, float2 u, float3 wo) {
#ifdef PRELIGHT_ANISOTROPY
  return mirroredAtVisibleNormal(u, wo, b.alphas);
#else
  return mirroredAtVisibleNormal(u, wo, (float2)(b.alpha));
#endif
}

// Returns what metal and layer scatter from wo to wi, times the cosine of wi: at the first bounce, and later ([4]).
PRELIGHT_INLINE float3 evalGlossy(Bsdf b, float3 wo, float3 wi) {
#ifdef PRELIGHT_MEASURED
  if (isMeasured(b)) return measuredRest(b.measured, wo, wi) * wi.z;
#endif
  const float3 h = normalize(wo + wi);
  const float2 from = firstBounce(b, wo), to = firstBounce(b, wi);
  const float later = (1.0f - from.x - from.y) * (1.0f - to.x - to.y) / fmax(b.missing, 1e-6f);
  return facetReflectance(b, dot(wo, h)) * evalFacets(b, wo, wi, h) +
         b.specular.later * (PRELIGHT_INVERSE_PI * wi.z * later);
}

// Returns the share of the rough lobe's light that leaves after the first bounce, which is sampled by the cosine.
PRELIGHT_INLINE float laterShare(Bsdf b, float3 wo) {
#ifdef PRELIGHT_MEASURED
  if (isMeasured(b)) return b.measuredShare;
#endif
  const float2 first = firstBounce(b, wo);
  const float later = largest(b.specular.later) * (1.0f - first.x - first.y);
#ifdef PRELIGHT_FILM
  const float sum = largest(facetReflectance(b, wo.z)) * (first.x + first.y) + later;
#else
  const float sum = largest(b.specular.f0) * first.x + largest(b.specular.f90) * first.y + later;
#endif
  return later > 0.0f ? later / sum : 0.0f;
}

PRELIGHT_INLINE float pdfGlossy(Bsdf b, float3 wo, float3 wi) {
  const float later = laterShare(b, wo);
  return (1.0f - later) * pdfFacets(b, wo, normalize(wo + wi)) + later * PRELIGHT_INVERSE_PI * wi.z;
}

// Samples metal and layer. The direction may lie below the surface. `chance`, in [0,1), picks the first bounce or later
// ones.
PRELIGHT_INLINE float3 sampleGlossy(Bsdf b, float chance, float2 u, float3 wo) {
  if (chance < laterShare(b, wo)) return sampleCosineHemisphere(u, (float3)(0.0f, 0.0f, 1.0f));
  return sampleFacets(b, u, wo);
}
#endif

#endif
