// How a surface scatters light. Directions are in the frame of the shading normal (z), away from the surface; wo
// towards where the path came from, wi towards where it goes. docs/reference.md states the model.
// [1] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (GGX).
// [2] Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2).
// [3] Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
// Options: PRELIGHT_GLOSSY (some surface reflects with roughness), PRELIGHT_MIRROR (some without), PRELIGHT_GLASS,
// PRELIGHT_TRANSLUCENT (some lets light through diffusely).
#ifndef PRELIGHT_SHADE_BSDF_FUNCS_CL
#define PRELIGHT_SHADE_BSDF_FUNCS_CL

#include "core/sampling_funcs.cl"

#define PRELIGHT_SMOOTH_BELOW 0.05f  // roughness; the lobe of a rougher one is still resolved by float32
#define PRELIGHT_INVERSE_PI 0.318309886f

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

// Parts of the scattered light, times the cosine of wi.
typedef struct Reflection {
  float3 diffuse;
  float3 glossy;
} Reflection;

// Probabilities with which scattering picks a lobe; they add up to 1 unless all are 0.
typedef struct LobeChoice {
  float diffuse;
  float specular;
  float glass;
#ifdef PRELIGHT_TRANSLUCENT
  float transmitted;
#endif
} LobeChoice;

float largest(float3 v) { return fmax(v.x, fmax(v.y, v.z)); }

// Schlick 1994.
float3 schlick(Bsdf b, float cosine) {
  const float k = clamp(1.0f - cosine, 0.0f, 1.0f);
  const float k2 = k * k;
  return b.f0 + (b.f90 - b.f0) * (k2 * k2 * k);
}

// Its mean over directions, weighted by the cosine: that of the rise is 1/21.
float3 meanLayer(Bsdf b) { return b.f0 + (b.f90 - b.f0) * (1.0f / 21.0f); }

// Share of unpolarised light that a dielectric reflects; eta = ior beyond / ior here. cosine in (0,1].
float fresnelDielectric(float cosine, float eta) {
  const float sine2 = (1.0f - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0f) return 1.0f;
  const float beyondCosine = sqrt(1.0f - sine2);
  const float s = (cosine - eta * beyondCosine) / (cosine + eta * beyondCosine);
  const float p = (eta * cosine - beyondCosine) / (eta * cosine + beyondCosine);
  return 0.5f * (s * s + p * p);
}

// [1] eq. 33, written so that no digits are lost around the normal.
float ggxDensity(float3 h, float alpha) {
  const float a2 = alpha * alpha;
  const float q = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 * PRELIGHT_INVERSE_PI / (q * q);
}

// cosine sqrt(1 + alpha2 tan2): the projected length in Smith's masking.
float smithTerm(float cosine, float alpha) {
  const float a2 = alpha * alpha;
  return sqrt(a2 + (1.0f - a2) * cosine * cosine);
}

// Height-correlated masking and shadowing over 4 cos cos, [2] eq. 99.
float smithVisibility(float co, float ci, float alpha) {
  return 0.5f / (co * smithTerm(ci, alpha) + ci * smithTerm(co, alpha));
}

// Normal visible from wo, [3].
float3 sampleVisibleNormal(float2 u, float3 wo, float alpha) {
  const float3 v = normalize((float3)(alpha * wo.x, alpha * wo.y, wo.z));
  const float z = (1.0f - u.y) * (1.0f + v.z) - v.z;
  const float radius = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  const float turn = 2.0f * u.x;
  const float3 h = (float3)(radius * cospi(turn), radius * sinpi(turn), z) + v;
  return normalize((float3)(alpha * h.x, alpha * h.y, fmax(h.z, 1e-7f)));
}

// Density of the direction that a visible normal h reflects wo to: D G1 / (4 cos), [2] eq. 17.
float visibleNormalDensity(float3 wo, float3 h, float alpha) {
  return 0.5f * ggxDensity(h, alpha) / (wo.z + smithTerm(wo.z, alpha));
}

// Whether the body scatters any light, to either side.
bool isDiffuse(Bsdf b) {
#ifdef PRELIGHT_TRANSLUCENT
  if (largest(b.transmitted) > 0.0f) return true;
#endif
  return largest(b.diffuse) > 0.0f;
}

// Whether light may come from or go to a direction of these cosines with the shading normal and the triangle's own. Both
// must tell the same side: else light would leak through the surface.
bool maySee(Bsdf b, float shading, float geometric) {
#ifdef PRELIGHT_TRANSLUCENT
  if (shading < 0.0f && geometric < 0.0f) return largest(b.transmitted) > 0.0f;
#endif
  return shading > 0.0f && geometric > 0.0f;
}

// The scattering from wo above the surface (z > 0) to wi, above or, of a translucent one, below; without what mirrors and
// glass do.
Reflection evaluateBsdf(Bsdf b, float3 wo, float3 wi) {
  Reflection r;
#ifdef PRELIGHT_TRANSLUCENT
  if (wi.z < 0.0f) {
    r.diffuse = b.transmitted * (PRELIGHT_INVERSE_PI * -wi.z * (1.0f - largest(schlick(b, wo.z))) *
                                 (1.0f - largest(schlick(b, -wi.z))));
    r.glossy = (float3)(0.0f);
    return r;
  }
#endif
  // Light that enters and leaves the body passes the layer twice: reciprocal, and never more than arrives.
  r.diffuse = b.diffuse * (PRELIGHT_INVERSE_PI * wi.z * (1.0f - largest(schlick(b, wo.z))) *
                           (1.0f - largest(schlick(b, wi.z))));
  r.glossy = (float3)(0.0f);
#ifdef PRELIGHT_GLOSSY
  if (!b.smooth) {
    const float3 h = normalize(wo + wi);
    const float lobe = ggxDensity(h, b.alpha) * smithVisibility(wo.z, wi.z, b.alpha) * wi.z;
    r.glossy = (b.metal + b.layer * schlick(b, dot(wo, h))) * lobe;
  }
#endif
  return r;
}

bool isSpecular(Bsdf b) {
#if defined(PRELIGHT_GLOSSY) || defined(PRELIGHT_MIRROR)
  return largest(b.metal) + b.layer > 0.0f;
#else
  return false;
#endif
}

bool isGlossy(Bsdf b) {
#ifdef PRELIGHT_GLOSSY
  return !b.smooth && isSpecular(b);
#else
  return false;
#endif
}

float lobeSum(LobeChoice c) {
  const float sum = c.diffuse + c.specular + c.glass;
#ifdef PRELIGHT_TRANSLUCENT
  return c.transmitted + sum;
#else
  return sum;
#endif
}

// In proportion to what the lobes scatter of light from wo, roughly.
LobeChoice chooseLobes(Bsdf b, float cosine, bool diffuse, bool glossy) {
  const float3 layer = schlick(b, cosine);
  LobeChoice c = {0.0f, 0.0f, 0.0f};
#ifdef PRELIGHT_TRANSLUCENT
  c.transmitted = diffuse && cosine > 0.0f ? largest(b.transmitted) * (1.0f - largest(layer)) : 0.0f;
#endif
  if (cosine > 0.0f) {
    if (diffuse) c.diffuse = largest(b.diffuse) * (1.0f - largest(layer));
#if defined(PRELIGHT_GLOSSY) || defined(PRELIGHT_MIRROR)
    if (glossy || b.smooth) c.specular = largest(b.metal + b.layer * layer);
#endif
  }
#ifdef PRELIGHT_GLASS
  c.glass = b.glass;
#endif
  const float sum = lobeSum(c);
  if (sum > 0.0f) {
    c.diffuse /= sum;
    c.specular /= sum;
    c.glass /= sum;
#ifdef PRELIGHT_TRANSLUCENT
    c.transmitted /= sum;
#endif
  }
  return c;
}

// Whether a chance in [0,1) picks the lobe below the surface. What is left of the chance decides among the others: it is
// negative then.
bool picksTransmitted(LobeChoice c, float* chance) {
#ifdef PRELIGHT_TRANSLUCENT
  const bool picks = *chance < c.transmitted;
  *chance -= c.transmitted;
  return picks;
#else
  return false;
#endif
}

// Density of wi over the lobes that are no mirrors.
float scatterDensity(Bsdf b, LobeChoice c, float3 wo, float3 wi) {
#ifdef PRELIGHT_TRANSLUCENT
  if (wi.z < 0.0f) return c.transmitted * PRELIGHT_INVERSE_PI * -wi.z;
#endif
  float density = c.diffuse * PRELIGHT_INVERSE_PI * wi.z;
#ifdef PRELIGHT_GLOSSY
  if (!b.smooth && c.specular > 0.0f) density += c.specular * visibleNormalDensity(wo, normalize(wo + wi), b.alpha);
#endif
  return density;
}

// Direction drawn from the diffuse (specular false) or glossy lobe; the latter's may lie below the surface. Upside down, the
// former's is one of the lobe below.
float3 sampleLobe(Bsdf b, bool specular, float2 u, float3 wo) {
#ifdef PRELIGHT_GLOSSY
  if (specular) {
    const float3 h = sampleVisibleNormal(u, wo, b.alpha);
    return 2.0f * dot(wo, h) * h - wo;
  }
#endif
  return sampleCosineHemisphere(u, (float3)(0.0f, 0.0f, 1.0f));
}

#endif
