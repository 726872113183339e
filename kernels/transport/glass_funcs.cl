// Smooth glass: reflection and refraction (docs/notes/reference.md), as radiance follows them.
#ifndef PRELIGHT_TRANSPORT_GLASS_FUNCS_CL
#define PRELIGHT_TRANSPORT_GLASS_FUNCS_CL

#include "transport/interaction_funcs.cl"
#include "transport/lobe_funcs.cl"

// The direction that light takes at glass.
typedef struct GlassSample {
  float3 direction;
  float3 weight;
  float eta2;       // square of the relative index of refraction that radiance has passed; 1 for importance
  float reflected;  // share that is reflected, by the normal that decided
  bool passes;
} GlassSample;

// Returns the ratio of the index of refraction beyond the surface to that here.
PRELIGHT_INLINE float relativeIor(Bsdf b, bool solid, bool front) { return solid && !front ? 1.0f / b.ior : b.ior; }

// Returns that ratio for transmitted light, whose index may be that of a wavelength.
PRELIGHT_INLINE float bendingIor(Bsdf b, bool solid, bool front) {
#ifdef PRELIGHT_DISPERSION
  return solid && !front ? 1.0f / b.bentIor : b.bentIor;
#else
  return relativeIor(b, solid, front);
#endif
}

#ifdef PRELIGHT_SPECULAR_GLASS
// Applies KHR_materials_specular to Fresnel's share: interpolates between the material's reflectances along the normal
// and at grazing angles by how far that share has risen. Total reflection is unchanged.
PRELIGHT_INLINE float3 specularGlass(Bsdf b, float reflected, float eta) {
  if (reflected >= 1.0f || b.ior == 0.0f) return (float3)(1.0f);
  return mix(b.glassF0, (float3)(b.glassF90), fresnelRise(reflected, eta));
}

#endif

#ifdef PRELIGHT_FILM_GLASS
// Applies a film to the share that the surface under it reflects. From within, it is the share for light from outside
// along the refracted direction.
PRELIGHT_INLINE float3 filmOnGlass(Bsdf b, float3 bare, float eta, float cosine) {
  const float outer2 = eta < 1.0f ? 1.0f - (1.0f - cosine * cosine) / (eta * eta) : cosine * cosine;
  if (!(b.film.share > 0.0f) || b.ior == 0.0f || outer2 <= 0.0f) return bare;
  return mix(bare, filmReflectance(sqrt(outer2), b.film.outside, b.film.ior, b.film.thickness, b.glassF0), b.film.share);
}
#endif

#ifdef PRELIGHT_COLORED_GLASS
// Returns the share of light that is reflected, per channel: by one surface, or by both of a thin sheet with all
// reflections between them.
PRELIGHT_INLINE float3 glassReflectances(Bsdf b, bool solid, float eta, float cosine) {
  const float bare = b.ior == 0.0f ? 1.0f : fresnelDielectric(cosine, eta);
#ifdef PRELIGHT_SPECULAR_GLASS
  float3 reflected = specularGlass(b, bare, eta);
#else
  float3 reflected = (float3)(bare);
#endif
#ifdef PRELIGHT_FILM_GLASS
  reflected = filmOnGlass(b, reflected, eta, cosine);
#endif
  return solid ? reflected : 2.0f * reflected / (1.0f + reflected);
}
#endif

// Returns the share of light that is not transmitted, for the channel that reflects most; 1 where nothing passes.
PRELIGHT_INLINE float glassReflectance(Bsdf b, bool solid, bool front, float cosine) {
#ifdef PRELIGHT_COLORED_GLASS
  return largest(glassReflectances(b, solid, relativeIor(b, solid, front), cosine));
#else
  const float reflected = b.ior == 0.0f ? 1.0f : fresnelDielectric(cosine, relativeIor(b, solid, front));
  return solid ? reflected : 2.0f * reflected / (1.0f + reflected);  // all the reflections between two faces
#endif
}

// Returns the colour of reflected light, with a largest channel of 1.
PRELIGHT_INLINE float3 glassColor(Bsdf b, bool solid, bool front, float cosine) {
#ifdef PRELIGHT_COLORED_GLASS
  const float3 reflected = glassReflectances(b, solid, relativeIor(b, solid, front), cosine);
  return reflected / fmax(largest(reflected), 1e-9f);
#else
  return (float3)(1.0f);
#endif
}

PRELIGHT_INLINE float glassCosine(float3 wo, float3 n) { return fmin(fmax(dot(wo, n), 1e-6f), 1.0f); }

PRELIGHT_INLINE float3 mirrorAbout(float3 wo, float3 n) { return 2.0f * dot(wo, n) * n - wo; }

// Returns the direction beyond the surface of light that came from wo. `n` is on wo's side, and reflection is not
// total.
PRELIGHT_INLINE float3 passGlass(Bsdf b, bool solid, bool front, float3 wo, float3 n) {
  if (!solid) return -wo;
  const float cosine = glassCosine(wo, n);
  const float eta = bendingIor(b, solid, front);
  const float inside = sqrt(fmax(1.0f - (1.0f - cosine * cosine) / (eta * eta), 0.0f));
  return normalize((cosine / eta - inside) * n - wo / eta);
}

// Samples reflection or refraction in proportion to Fresnel's share: `chance` is in [0,1). `n` is on i.wo's side.
PRELIGHT_INLINE GlassSample sampleGlassAbout(Interaction i, Bsdf b, float3 n, float chance) {
  const bool solid = isSolid(i);
  const float eta = bendingIor(b, solid, i.front);
  GlassSample g;
  g.reflected = glassReflectance(b, solid, i.front, glassCosine(i.wo, n));
  g.passes = chance >= g.reflected;
  g.weight = g.passes ? b.tint : glassColor(b, solid, i.front, glassCosine(i.wo, n));
  g.eta2 = g.passes && solid ? eta * eta : 1.0f;
  g.direction = g.passes ? passGlass(b, solid, i.front, i.wo, n) : mirrorAbout(i.wo, n);
  return g;
}

// Samples glass for radiance. Where the shading normal would send light to the wrong side, the triangle's own is used.
PRELIGHT_INLINE GlassSample sampleGlassRadiance(Interaction i, Bsdf b, float chance) {
  const GlassSample g = sampleGlassAbout(i, b, i.woLocal.z > 0.0f ? i.frame.z : i.geometric, chance);
  if ((dot(g.direction, i.geometric) < 0.0f) == g.passes) return g;
  return sampleGlassAbout(i, b, i.geometric, chance);
}

#endif
