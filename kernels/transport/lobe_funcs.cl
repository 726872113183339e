// The lobes of a surface's scattering, and the parameters of the materials from which they follow. docs/notes/reference.md
// states the model.
// [1] Kelemen and Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling".
// Options: PRELIGHT_GLOSSY (some surface reflects with roughness), PRELIGHT_MIRROR (some reflects without),
// PRELIGHT_GLASS, PRELIGHT_DISPERSION (some glass refracts by wavelength), PRELIGHT_SPECULAR_GLASS (the reflectance of
// some glass differs from that of its index of refraction), PRELIGHT_LAYERS (some surface has a clear coat or a sheen;
// needs PRELIGHT_GLOSSY), PRELIGHT_ANISOTROPY (some lobe has two widths; needs PRELIGHT_GLOSSY), PRELIGHT_FILM (some
// surface lies under a thin film; needs PRELIGHT_GLOSSY), PRELIGHT_FILM_GLASS (some of these are glass),
// PRELIGHT_MEASURED (some reflectance was measured; needs PRELIGHT_GLOSSY), PRELIGHT_ROUGH_GLASS (some glass is rough;
// needs PRELIGHT_GLOSSY), PRELIGHT_TRANSLUCENT (some surface lets light through diffusely), PRELIGHT_BUMPS (some
// material has a normal texture).
#ifndef PRELIGHT_TRANSPORT_LOBE_FUNCS_CL
#define PRELIGHT_TRANSPORT_LOBE_FUNCS_CL

#include "core/inline.h"
#include "core/vector_funcs.cl"
#include "transport/anisotropic_albedo_funcs.cl"
#include "transport/lobe_math_funcs.cl"
#ifdef PRELIGHT_MEASURED
#include "transport/measured_funcs.cl"
#endif

#if defined(PRELIGHT_SPECULAR_GLASS) || defined(PRELIGHT_FILM_GLASS)
#define PRELIGHT_COLORED_GLASS  // the reflection of some glass has a colour
#endif

// Least deviation from 1 of the relative index of refraction for rough glass: float32 does not resolve the half vectors
// of a smaller one.
#define PRELIGHT_LEAST_BEND 1e-3f
// Surfaces of less roughness are mirrors; float32 still resolves the lobes of rougher ones.
#define PRELIGHT_SMOOTH_BELOW 0.05f
#define PRELIGHT_NARROW_ALPHA 0.0625f  // roughness 0.25, as in host/photon/photon_sources.h
#define PRELIGHT_INVERSE_PI 0.318309886f

// Quantity that a path carries: radiance, traced backwards from the eye or a receiver, or importance (a photon's
// power), traced forwards from a light.
#define PRELIGHT_RADIANCE 0u
#define PRELIGHT_IMPORTANCE 1u

// Sets of lobes. A sample comes from one lobe.
#define PRELIGHT_LOBE_DIFFUSE 1u
#define PRELIGHT_LOBE_THROUGH 2u             // diffuse transmission to the other side
#define PRELIGHT_LOBE_GLOSSY 4u              // metal and layer if rough
#define PRELIGHT_LOBE_MIRROR 8u              // metal and layer if smooth
#define PRELIGHT_LOBE_GLASS_REFLECTION 16u
#define PRELIGHT_LOBE_GLASS_TRANSMISSION 32u
#define PRELIGHT_LOBE_COAT 64u               // clear coat if rough; a smooth one counts as a mirror
#define PRELIGHT_LOBE_SHEEN 128u
#define PRELIGHT_LOBES_LAYERS (PRELIGHT_LOBE_COAT | PRELIGHT_LOBE_SHEEN)
#define PRELIGHT_LOBES_DIFFUSE (PRELIGHT_LOBE_DIFFUSE | PRELIGHT_LOBE_THROUGH)
#define PRELIGHT_LOBES_GLASS (PRELIGHT_LOBE_GLASS_REFLECTION | PRELIGHT_LOBE_GLASS_TRANSMISSION)
// Lobes that scatter to single directions.
#define PRELIGHT_LOBES_SPECULAR (PRELIGHT_LOBE_MIRROR | PRELIGHT_LOBES_GLASS)
#define PRELIGHT_LOBES_ALL (PRELIGHT_LOBES_DIFFUSE | PRELIGHT_LOBE_GLOSSY | PRELIGHT_LOBES_SPECULAR | PRELIGHT_LOBES_LAYERS)

// Reflectance of microfacets: of metal, or of the layer on a dielectric.
typedef struct Reflectance {
  float3 f0;     // along the normal
  float3 f90;    // at grazing angles
  float3 later;  // reflectance of light that does not leave at the first bounce (laterReflectance)
} Reflectance;

// Scattering parameters of a surface point: metal, a diffuse body under a dielectric layer, glass, and sheen and clear
// coat over these.
typedef struct Bsdf {
  float3 diffuse;  // albedo of the diffuse body
#ifdef PRELIGHT_TRANSLUCENT
  float3 transmitted;  // albedo of the body for light that leaves on the other side
#endif
#ifdef PRELIGHT_BUMPS
  bool bumped;  // the material has a normal texture
  float3 body;  // unit normal for diffuse scattering, in the frame of the shading normal: Interaction::body
#endif
  Reflectance specular;  // metal and layer, times their shares of the surface
  float3 layer;          // f0, f90 and later of the layer where it covers the body, by their largest channels
  float bodyGain;        // 1 / mean share of light that passes the layer
  float glass;           // share that is glass
  float3 tint;           // colour of light that passes through the glass
  float ior;             // index of refraction; 0 when infinite
#ifdef PRELIGHT_DISPERSION
  float bentIor;  // index with which glass refracts; `ior` determines what it reflects
#endif
#ifdef PRELIGHT_COLORED_GLASS
  float3 glassF0;  // reflectance of the glass along its normal
  float glassF90;  // reflectance of the glass at grazing angles
#endif
#ifdef PRELIGHT_ROUGH_GLASS
  float eta;   // solid glass: index of refraction beyond the surface / that here
  bool solid;  // glass with an inside
  bool inside;      // this side of the surface is inside
  uint glassTable;  // entry of `albedos` at which the table of its index of refraction begins
#endif
  float roughness;
  float alpha;           // width of the GGX lobe, roughness squared
#ifdef PRELIGHT_FILM
  Film film;
#endif
#ifdef PRELIGHT_ANISOTROPY
  float2 alphas;  // widths along the frame's x and y of metal and layer; the first is the larger one
#endif
#ifdef PRELIGHT_MEASURED
  // Table of the measured reflectance that replaces metal and layer; 0: there is none.
  __global const float* measured;
  float measuredShare;             // probability of sampling it by the cosine rather than by the GGX lobe
#endif
  float missing;         // mean share of light that does not leave microfacets at the first bounce
  bool smooth;           // metal and layer are mirrors
#ifdef PRELIGHT_LAYERS
  float coat;         // share of the surface that has a clear coat
  float coatRoughness;
  bool coatSmooth;    // the coat is a mirror
  float3 coatNormal;  // the coat is a mirror
  float3 sheen;       // colour
  float sheenRoughness;
  float sheenAlpha;   // sheenRoughness squared
#endif
  __global const float4* albedos;  // see transport/albedo_table_funcs.cl; read only with PRELIGHT_GLOSSY
} Bsdf;

PRELIGHT_INLINE bool isMeasured(Bsdf b) {
#ifdef PRELIGHT_MEASURED
  return b.measured != 0;
#else
  return false;
#endif
}

PRELIGHT_INLINE bool isAnisotropic(Bsdf b) {
#ifdef PRELIGHT_ANISOTROPY
  return b.alphas.x > b.alphas.y;
#else
  return false;
#endif
}

// Returns the microfacets' albedo at the first bounce for a direction above the surface: the factors of f0 and of f90.
PRELIGHT_INLINE float2 firstBounce(Bsdf b, float3 w) {
#ifdef PRELIGHT_ANISOTROPY
  if (isAnisotropic(b)) return anisotropicAlbedo(b.albedos, w, b.alphas.x, b.alphas.y).xy;
#endif
#ifdef PRELIGHT_GLOSSY
  if (!b.smooth) return lobeAlbedo(b.albedos, w.z, b.roughness).xy;
#endif
  return smoothBounce(w.z);
}

// Returns the reflectance of metal and layer at a microfacet, times their shares of the surface, for light under this
// cosine with its normal.
PRELIGHT_INLINE float3 facetReflectance(Bsdf b, float cosine) {
  const float rise = schlickRise(cosine);
  float3 reflected = b.specular.f0 * (1.0f - rise) + b.specular.f90 * rise;
#ifdef PRELIGHT_FILM
  if (b.film.share > 0.0f) return filmedReflectance(b.film, cosine, reflected);
#endif
  return reflected;
}

// Returns the directional albedo of metal and layer for a direction above the surface. Under a film over a rough
// surface, the reflectance of the surface as a whole stands for that of its microfacets.
PRELIGHT_INLINE float3 specularAlbedo(Bsdf b, float3 w) {
#ifdef PRELIGHT_MEASURED
  if (isMeasured(b)) return measuredAlbedo(b.measured, w.z);
#endif
  const float2 first = firstBounce(b, w);
#ifdef PRELIGHT_FILM
  if (b.film.share > 0.0f)
    return facetReflectance(b, w.z) * (first.x + first.y) + b.specular.later * (1.0f - first.x - first.y);
#endif
  return b.specular.f0 * first.x + b.specular.f90 * first.y + b.specular.later * (1.0f - first.x - first.y);
}

PRELIGHT_INLINE float passage(Bsdf b, float3 w) {
#if defined(PRELIGHT_GLOSSY) || defined(PRELIGHT_MIRROR)
#ifdef PRELIGHT_FILM
  if (b.film.share > 0.0f && b.film.layerShare > 0.0f)
    return passedFilm(b.layer, b.film.share, firstBounce(b, w),
                      filmAlbedo(b.albedos, b.film.table, b.film.relative, w.z, b.smooth ? 0.0f : b.roughness));
#endif
  return passedLayer(b.layer, firstBounce(b, w));
#else
  return 1.0f;
#endif
}

#ifdef PRELIGHT_FILM
// Completes the parts of setReflectance that depend on a film. `bare`: later reflectance of the layer where it has no
// film.
PRELIGHT_INLINE void setFilmReflectance(float3 metal, float metalShare, float3 layer, float3 bare, float layerShare, float2 mean,
                                        Bsdf* b) {
  Film* f = &b->film;
  f->metal = metal;
  f->metalShare = metalShare;
  f->layer = layer;
  f->layerShare = layerShare;
  const float3 metalLater = laterUnderFilm(*f, metal, laterReflectance(metal, (float3)(1.0f), b->missing), b->missing);
  const float3 layerLater = laterUnderFilm(*f, layer, bare, b->missing);
  b->specular.later = metalShare * metalLater + layerShare * layerLater;
  if (!(layerShare > 0.0f)) return;
  b->layer.z = largest(layerLater);
  const float roughness = b->smooth ? 0.0f : b->roughness;
  b->bodyGain = 1.0f / fmax(passedFilm(b->layer, f->share, mean, meanFilmAlbedo(b->albedos, f->table, f->relative, roughness)), 1e-6f);
}
#endif

// Completes a Bsdf whose roughness, albedos, film and diffuse parts are set: a metal of this reflectance and a layer,
// with the shares of the surface that they cover.
PRELIGHT_INLINE void setReflectance(float3 metal, float metalShare, float3 layerF0, float layerF90, float layerShare, Bsdf* b) {
  float2 mean = (float2)(20.0f / 21.0f, 1.0f / 21.0f);
#ifdef PRELIGHT_GLOSSY
  if (!b->smooth) mean = meanLobeAlbedo(b->albedos, b->roughness).xy;
#endif
#ifdef PRELIGHT_ANISOTROPY
  if (isAnisotropic(*b)) mean = meanAnisotropicAlbedo(b->albedos, b->alphas.x, b->alphas.y).xy;
#endif
  b->missing = b->smooth ? 0.0f : fmax(1.0f - mean.x - mean.y, 0.0f);
  const float3 white = (float3)(1.0f), layerRise = (float3)(layerF90);
  const float3 layerLater = laterReflectance(layerF0, layerRise, b->missing);
  b->specular.f0 = metalShare * metal + layerShare * layerF0;
  b->specular.f90 = metalShare * white + layerShare * layerRise;
  b->specular.later = metalShare * laterReflectance(metal, white, b->missing) + layerShare * layerLater;
  b->layer = layerShare > 0.0f ? (float3)(largest(layerF0), layerF90, largest(layerLater)) : (float3)(0.0f);
  b->bodyGain = 1.0f / fmax(passedLayer(b->layer, mean), 1e-6f);
#ifdef PRELIGHT_FILM
  b->film.metalShare = b->film.layerShare = 0.0f;
  if (b->film.share > 0.0f) setFilmReflectance(metal, metalShare, layerF0, layerLater, layerShare, mean, b);
#endif
}

// Returns true when the body scatters any light, to either side.
PRELIGHT_INLINE bool isDiffuse(Bsdf b) {
#ifdef PRELIGHT_TRANSLUCENT
  if (largest(b.transmitted) > 0.0f) return true;
#endif
  return largest(b.diffuse) > 0.0f;
}

#ifdef PRELIGHT_ROUGH_GLASS
// Returns true for glass that scatters by microfacets. Glass with the index of its surroundings bends no light, however
// its microfacets lie: it counts as smooth.
PRELIGHT_INLINE bool isRoughGlass(Bsdf b) {
  return !b.smooth && b.glass > 0.0f && !(b.solid && fabs(b.eta - 1.0f) < PRELIGHT_LEAST_BEND);
}
#endif

PRELIGHT_INLINE bool isGlossy(Bsdf b) {
#ifdef PRELIGHT_ROUGH_GLASS
  if (isRoughGlass(b)) return true;
#endif
#ifdef PRELIGHT_LAYERS
  if ((b.coat > 0.0f && !b.coatSmooth) || largest(b.sheen) > 0.0f) return true;
#endif
#ifdef PRELIGHT_GLOSSY
  return isMeasured(b) || (!b.smooth && largest(b.specular.f90) > 0.0f);
#else
  return false;
#endif
}

// Returns true for mirrors and for lobes narrow enough to show images: the light that they focus is followed from its
// source, while that of wider lobes is found by chance.
PRELIGHT_INLINE bool isNarrow(Bsdf b) {
#ifdef PRELIGHT_ANISOTROPY
  return b.smooth || b.alphas.x <= PRELIGHT_NARROW_ALPHA;
#else
  return b.smooth || b.alpha <= PRELIGHT_NARROW_ALPHA;
#endif
}

// Returns a direction that points as far above the surface as the given one points above or below.
PRELIGHT_INLINE float3 upwards(float3 wi) { return (float3)(wi.x, wi.y, fabs(wi.z)); }

// Returns the normal for diffuse scattering. It is the same from wherever the eye looks; specular reflection uses the
// frame's.
PRELIGHT_INLINE float3 bodyNormal(Bsdf b) {
#ifdef PRELIGHT_BUMPS
  return b.body;
#else
  return (float3)(0.0f, 0.0f, 1.0f);
#endif
}

// Returns the cosine of a direction with bodyNormal.
PRELIGHT_INLINE float bodyCosine(Bsdf b, float3 w) {
#ifdef PRELIGHT_BUMPS
  return dot(w, b.body);
#else
  return w.z;
#endif
}

// Returns a direction mirrored to the other side of the body's surface.
PRELIGHT_INLINE float3 beyondBody(Bsdf b, float3 w) {
#ifdef PRELIGHT_BUMPS
  return w - 2.0f * dot(w, b.body) * b.body;
#else
  return (float3)(w.x, w.y, -w.z);
#endif
}

// Returns the direction for passage() of light that enters or leaves the body.
PRELIGHT_INLINE float3 bodyWay(Bsdf b, float3 w) {
#ifdef PRELIGHT_BUMPS
  if (b.body.z < 1.0f && !isAnisotropic(b)) {
    const float cosine = fmin(fabs(bodyCosine(b, w)), 1.0f);
    return (float3)(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  }
#endif
  return upwards(w);
}

// Returns the lobes that cause caustics. These include solid rough glass: rays that look for a lamp behind it find it
// only by rare chance.
PRELIGHT_INLINE uint narrowLobes(Bsdf b) {
  uint lobes = PRELIGHT_LOBES_SPECULAR | (isNarrow(b) ? PRELIGHT_LOBE_GLOSSY : 0u);
#ifdef PRELIGHT_ROUGH_GLASS
  if (!isNarrow(b) && !b.solid) lobes &= ~PRELIGHT_LOBES_GLASS;
#endif
#ifdef PRELIGHT_LAYERS
  if (b.coatRoughness * b.coatRoughness <= PRELIGHT_NARROW_ALPHA) lobes |= PRELIGHT_LOBE_COAT;
#endif
  return lobes;
}

#endif
