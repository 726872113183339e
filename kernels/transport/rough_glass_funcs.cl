// Rough glass: microfacets that reflect and refract. Directions are in the frame of the shading normal (z); wi below it
// is transmitted. Values are those of power: radiance that has passed solid glass is smaller by the square of the
// relative index.
// [1] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".
// [2] KHR_materials_transmission: thin glass scatters what passes as a mirror image of what it reflects.
#ifndef PRELIGHT_TRANSPORT_ROUGH_GLASS_FUNCS_CL
#define PRELIGHT_TRANSPORT_ROUGH_GLASS_FUNCS_CL

#include "transport/glass_funcs.cl"
#include "transport/microfacet_funcs.cl"

#ifdef PRELIGHT_ROUGH_GLASS
// Cosine at which light that leaves thin glass after the first bounce is divided between the sides.
#define PRELIGHT_LATER_COSINE 0.6f

PRELIGHT_INLINE float roughGlassReflectance(Bsdf b, float cosine) {
#ifdef PRELIGHT_COLORED_GLASS
  return largest(glassReflectances(b, b.solid, b.eta, clamp(cosine, 1e-6f, 1.0f)));
#else
  const float reflected = b.ior == 0.0f ? 1.0f : fresnelDielectric(clamp(cosine, 1e-6f, 1.0f), b.eta);
  return b.solid ? reflected : 2.0f * reflected / (1.0f + reflected);
#endif
}

// Finds the normal that refracts wo to wi, and the density of wi when normals visible from wo are drawn, [1] eq. 17.
// Returns false when there is none.
PRELIGHT_INLINE bool refractingNormal(Bsdf b, float3 wo, float3 wi, float* density, float3* h) {
  const float3 sum = wo + b.eta * wi;
  const float square = dot(sum, sum);
  if (!(square > 1e-12f)) return false;
  *h = sum * (rsqrt(square) * (sum.z < 0.0f ? -1.0f : 1.0f));
  const float from = dot(wo, *h), to = dot(wi, *h), both = from + b.eta * to;
  if (!(from > 0.0f && to < 0.0f) || both == 0.0f) return false;
  *density = ggxDensity(*h, b.alpha) * smithMasking(wo.z, b.alpha) * from / wo.z * b.eta * b.eta * -to / (both * both);
  return true;
}

// Returns the share of light that leaves thin glass after the first bounce.
PRELIGHT_INLINE float laterInGlass(Bsdf b, float cosine) {
  if (b.solid) return 0.0f;
  const float4 first = lobeAlbedo(b.albedos, cosine, b.roughness);
  return fmax(1.0f - first.x - first.y, 0.0f);
}

// Returns the share of light scattered by microfacets of glass, under this cosine with their normal, that goes to the
// side of wi, and its colour.
PRELIGHT_INLINE float3 sideOfGlass(Bsdf b, float cosine, bool passes) {
#ifdef PRELIGHT_COLORED_GLASS
  if (!passes) return glassReflectances(b, b.solid, b.eta, clamp(cosine, 1e-6f, 1.0f));
#endif
  const float reflected = roughGlassReflectance(b, cosine);
  return passes ? (1.0f - reflected) * b.tint : (float3)(reflected);
}

// Returns the albedo of solid glass at the first bounce for light along the eye's direction, below the surface or above
// it. All scattered light is divided by it, so that light trapped between microfacets leaves like the rest.
PRELIGHT_INLINE float scatteredByGlass(Bsdf b, float3 eye) {
  if (!b.solid) return 1.0f;
  const float4 albedo =
      betweenAlbedos(b.albedos, (int)b.glassTable, PRELIGHT_GLASS_COSINES, PRELIGHT_GLASS_ROUGHNESSES, fabs(eye.z), b.roughness);
  return fmax(b.inside != (eye.z < 0.0f) ? albedo.y : albedo.x, 0.05f);
}

// Evaluates rough glass, times the cosine of wi, without the division by scatteredByGlass.
PRELIGHT_INLINE float3 evalRoughGlassOnce(Bsdf b, float3 wo, float3 wi) {
  const bool passes = wi.z < 0.0f;
  if (passes && b.solid) {
    float density;
    float3 h;
    if (!refractingNormal(b, wo, wi, &density, &h)) return (float3)(0.0f);
    return sideOfGlass(b, dot(wo, h), true) * (b.glass * density * smithMasking(-wi.z, b.alpha));
  }
  const float3 mirrored = upwards(wi), h = normalize(wo + mirrored);
  const float later = laterInGlass(b, wo.z) * laterInGlass(b, mirrored.z) / fmax(b.missing, 1e-6f);
  return b.glass * (sideOfGlass(b, dot(wo, h), passes) * evalMicrofacet(wo, mirrored, h, b.alpha) +
                    sideOfGlass(b, PRELIGHT_LATER_COSINE, passes) *
                        (PRELIGHT_INVERSE_PI * mirrored.z * later));
}

// Evaluates rough glass, times the cosine of wi. `eye`: the one of the two directions to which light goes.
PRELIGHT_INLINE float3 evalRoughGlass(Bsdf b, float3 wo, float3 wi, float3 eye) {
  return evalRoughGlassOnce(b, wo, wi) / scatteredByGlass(b, eye);
}

PRELIGHT_INLINE float pdfRoughGlass(Bsdf b, float3 wo, float3 wi) {
  const bool passes = wi.z < 0.0f;
  if (passes && b.solid) {
    float density;
    float3 h;
    if (!refractingNormal(b, wo, wi, &density, &h)) return 0.0f;
    return (1.0f - roughGlassReflectance(b, dot(wo, h))) * density;
  }
  const float3 mirrored = upwards(wi), h = normalize(wo + mirrored);
  const float first = roughGlassReflectance(b, dot(wo, h)), last = roughGlassReflectance(b, PRELIGHT_LATER_COSINE);
  const float later = laterInGlass(b, wo.z);
  return (1.0f - later) * (passes ? 1.0f - first : first) * pdfMicrofacet(wo, h, b.alpha) +
         later * (passes ? 1.0f - last : last) * PRELIGHT_INVERSE_PI * mirrored.z;
}

// Samples wi. `chance`, in [0,1), decides between bounces and between sides. Returns false when there is no direction.
PRELIGHT_INLINE bool sampleRoughGlass(Bsdf b, float3 wo, float chance, float2 u, float3* wi) {
  const float later = laterInGlass(b, wo.z);
  const bool isLater = chance < later;
  chance = isLater ? chance / later : (chance - later) / (1.0f - later);
  const float3 h = isLater ? (float3)(0.0f, 0.0f, 1.0f) : sampleVisibleNormal(u, wo, (float2)(b.alpha));
  const float from = dot(wo, h);
  const bool passes = chance >= roughGlassReflectance(b, isLater ? PRELIGHT_LATER_COSINE : from);
  *wi = isLater ? sampleCosineHemisphere(u, h) : 2.0f * from * h - wo;
  if (passes && !b.solid) wi->z = -wi->z;
  if (passes && b.solid) {
    const float inside2 = 1.0f - (1.0f - from * from) / (b.eta * b.eta);
    *wi = normalize((from / b.eta - sqrt(fmax(inside2, 0.0f))) * h - wo / b.eta);
  }
  return passes ? wi->z < 0.0f : wi->z > 0.0f;
}
#endif

#endif
