// The mathematics of lobes, apart from where a surface's parameters come from: Fresnel's terms, microfacets, the dielectric's
// layer and films over it, clear coat and sheen. OpenCL C and GLSL.
// [1] Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (GGX).
// [2] Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2).
// [3] Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
#ifndef PRELIGHT_TRANSPORT_LOBE_MATH_FUNCS_CL
#define PRELIGHT_TRANSPORT_LOBE_MATH_FUNCS_CL

#include "core/dialect.h"
#include "core/largest_funcs.cl"
#include "transport/albedo_table_funcs.cl"
#include "transport/film_funcs.cl"

#define PRELIGHT_COAT_F0 0.04f

// Returns how far reflectance has risen from that along the normal to that at grazing angles (Schlick 1994).
PRELIGHT_INLINE float schlickRise(float cosine) {
  float k = clamp(1.0f - cosine, 0.0f, 1.0f);
  float k2 = k * k;
  return k2 * k2 * k;
}

// Returns the share of unpolarised light that a dielectric reflects; eta = ior beyond / ior here. cosine in (0,1].
PRELIGHT_INLINE float fresnelDielectric(float cosine, float eta) {
  float sine2 = (1.0f - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0f) return 1.0f;
  float beyondCosine = sqrt(1.0f - sine2);
  float s = (cosine - eta * beyondCosine) / (cosine + eta * beyondCosine);
  float p = (eta * cosine - beyondCosine) / (eta * cosine + beyondCosine);
  return 0.5f * (s * s + p * p);
}

// Returns how far Fresnel's share has risen from that along the normal to 1, given the relative index of refraction.
PRELIGHT_INLINE float fresnelRise(float reflected, float eta) {
  float root = (eta - 1.0f) / (eta + 1.0f);
  float least = root * root;
  return clamp((reflected - least) / MAX(1.0f - least, 1e-6f), 0.0f, 1.0f);
}

// Returns cosine sqrt(1 + alpha2 tan2), the projected length in Smith's masking.
PRELIGHT_INLINE float smithTerm(float cosine, float alpha) {
  float a2 = alpha * alpha;
  return sqrt(a2 + (1.0f - a2) * cosine * cosine);
}

// Returns height-correlated masking and shadowing divided by 4 cos cos, [2] eq. 99.
PRELIGHT_INLINE float smithVisibility(float co, float ci, float alpha) {
  return 0.5f / (co * smithTerm(ci, alpha) + ci * smithTerm(co, alpha));
}

// Returns Smith's masking for one direction, [1] eq. 34.
PRELIGHT_INLINE float smithMasking(float cosine, float alpha) { return 2.0f * cosine / (cosine + smithTerm(cosine, alpha)); }

// Returns the GGX density of normals for widths along x and y.
PRELIGHT_INLINE float anisotropicDensity(vec3 h, vec2 alphas) {
  vec2 slope = h.xy / alphas;
  float q = slope.x * slope.x + slope.y * slope.y + h.z * h.z;
  return 0.318309886f / (alphas.x * alphas.y * q * q);
}

PRELIGHT_INLINE float anisotropicTerm(vec3 w, vec2 alphas) {
  vec2 across = alphas * w.xy;
  return sqrt(w.z * w.z + across.x * across.x + across.y * across.y);
}

// Returns the albedo of a smooth surface at its only bounce: the factors of f0 and of f90.
PRELIGHT_INLINE vec2 smoothBounce(float cosine) {
  float rise = schlickRise(cosine);
  return VEC2(1.0f - rise, rise);
}

// Returns the share of the light along a direction that passes a layer, given the layer's f0, f90 and later reflectance and its
// albedos at the first bounce.
PRELIGHT_INLINE float passedLayer(vec3 layer, vec2 first) {
  return MAX(1.0f - (layer.x * first.x + layer.y * first.y + layer.z * (1.0f - first.x - first.y)), 0.0f);
}

// As passedLayer, for a layer of which a share lies under a film; `under`: albedo of that part at the first bounce.
PRELIGHT_INLINE float passedFilm(vec3 layer, float share, vec2 first, float under) {
  float bare = layer.x * first.x + layer.y * first.y;
  return MAX(1.0f - mix(bare, under, share) - layer.z * (1.0f - first.x - first.y), 0.0f);
}

// A thin film over metal and layer.
struct Film {
  float share;      // share of the surface that has the film
  float outside;    // index of refraction of the medium above it
  float ior;
  float thickness;  // nm
  float relative;   // thickness in its range, 0 to 1
  int table;        // entry of the albedos at which the table of the layer under it begins
  float metalShare, layerShare;  // shares of the surface
  vec3 metal, layer;             // reflectance along the normal of the surface below
};
STRUCT_NAME(Film)

// Returns the reflectance of metal and layer at a microfacet where a film covers a part of them; `bare`: without it.
PRELIGHT_INLINE vec3 filmedReflectance(Film f, float cosine, vec3 bare) {
  vec3 reflected = bare * (1.0f - f.share);
  if (f.metalShare > 0.0f) reflected += f.share * f.metalShare * filmReflectance(cosine, f.outside, f.ior, f.thickness, f.metal);
  if (f.layerShare > 0.0f) reflected += f.share * f.layerShare * filmReflectance(cosine, f.outside, f.ior, f.thickness, f.layer);
  return reflected;
}

// Returns the later reflectance under a film over a surface that reflects `below`.
PRELIGHT_INLINE vec3 laterUnderFilm(Film f, vec3 below, vec3 bare, float missing) {
  return mix(bare, laterOfMean(meanFilmReflectance(f.outside, f.ior, f.thickness, below), missing), f.share);
}

PRELIGHT_INLINE float coatReflectance(float cosine) { return PRELIGHT_COAT_F0 + (1.0f - PRELIGHT_COAT_F0) * schlickRise(cosine); }

// Returns the albedo of a clear coat over a share of the surface for a direction of this cosine with its normal.
PRELIGHT_INLINE float albedoOfCoat(TEXELS table, float share, float roughness, bool isMirror, float cosine) {
  if (isMirror) return share * coatReflectance(cosine);
  vec2 first = lobeAlbedo(table, cosine, roughness).xy;
  return share * (PRELIGHT_COAT_F0 * first.x + first.y);
}

// Returns the fit of Lambda, [3] eq. 3.
PRELIGHT_INLINE float sheenFit(float x, float alpha) {
  float k = (1.0f - alpha) * (1.0f - alpha);
  float a = mix(21.5473f, 25.3245f, k), b = mix(3.82987f, 3.32435f, k), c = mix(0.19823f, 0.16801f, k);
  float d = mix(-1.97760f, -1.27393f, k), e = mix(-4.32054f, -4.85967f, k);
  return a / (1.0f + b * pow(x, c)) + d * x + e;
}

PRELIGHT_INLINE float sheenLambda(float cosine, float alpha) {
  float x = clamp(cosine, 1e-4f, 1.0f);
  return x < 0.5f ? exp(sheenFit(x, alpha)) : exp(2.0f * sheenFit(0.5f, alpha) - sheenFit(MAX(1.0f - x, 1e-6f), alpha));
}

// Returns the lobe of a sheen of colour 1 times the cosine of the light, given the cosines of eye, light and half vector.
PRELIGHT_INLINE float sheenLobe(float toEye, float toLight, float between, float alpha) {
  float inverse = 1.0f / alpha;
  float density = (2.0f + inverse) * pow(MAX(1.0f - between * between, 0.0f), 0.5f * inverse) * (0.5f * 0.318309886f);
  return density / ((1.0f + sheenLambda(toEye, alpha) + sheenLambda(toLight, alpha)) * 4.0f * MAX(toEye, 1e-6f));
}

#endif
