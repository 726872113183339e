// The rough lobe: GGX microfacets, single scattering. Directions are in the frame of the shading normal (z).
// [1] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (GGX).
// [2] Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2).
// [3] Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
#ifndef PRELIGHT_TRANSPORT_MICROFACET_FUNCS_CL
#define PRELIGHT_TRANSPORT_MICROFACET_FUNCS_CL

#include "transport/lobe_funcs.cl"

// [1] eq. 33, written so that no digits are lost around the normal.
PRELIGHT_INLINE float ggxDensity(float3 h, float alpha) {
  const float a2 = alpha * alpha;
  const float q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 * PRELIGHT_INVERSE_PI / (q * q);
}

// cosine sqrt(1 + alpha2 tan2): the projected length in Smith's masking.
PRELIGHT_INLINE float smithTerm(float cosine, float alpha) {
  const float a2 = alpha * alpha;
  return sqrt(a2 + (1.0f - a2) * cosine * cosine);
}

// Height-correlated masking and shadowing over 4 cos cos, [2] eq. 99.
PRELIGHT_INLINE float smithVisibility(float co, float ci, float alpha) {
  return 0.5f / (co * smithTerm(ci, alpha) + ci * smithTerm(co, alpha));
}

// Normal visible from wo, [3].
PRELIGHT_INLINE float3 sampleVisibleNormal(float2 u, float3 wo, float alpha) {
  const float3 v = normalize((float3)(alpha * wo.x, alpha * wo.y, wo.z));
  const float z = (1.0f - u.y) * (1.0f + v.z) - v.z;
  const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  const float turn = 2.0f * u.x;
  const float3 h = (float3)(radius * cospi(turn), radius * sinpi(turn), z) + v;
  return normalize((float3)(alpha * h.x, alpha * h.y, fmax(h.z, 1e-7f)));
}

// The lobe without its reflectance, times the cosine of wi; h: halfway between wo and wi.
PRELIGHT_INLINE float evalMicrofacet(float3 wo, float3 wi, float3 h, float alpha) {
  return ggxDensity(h, alpha) * smithVisibility(wo.z, wi.z, alpha) * wi.z;
}

// Density of the direction that a visible normal h reflects wo to: D G1 / (4 cos), [2] eq. 17.
PRELIGHT_INLINE float pdfMicrofacet(float3 wo, float3 h, float alpha) {
  return 0.5f * ggxDensity(h, alpha) / (wo.z + smithTerm(wo.z, alpha));
}

// May lie below the surface.
PRELIGHT_INLINE float3 sampleMicrofacet(float2 u, float3 wo, float alpha) {
  const float3 h = sampleVisibleNormal(u, wo, alpha);
  return 2.0f * dot(wo, h) * h - wo;
}

#endif
