// Scattering of light by a surface: evalBsdf evaluates it, sampleBsdf draws a direction, pdfBsdf returns the density.
// The caller chooses lobes and whether it follows radiance or importance; these functions handle the difference.
// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", ch. 5.
// Options: those of transport/lobe_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_BSDF_FUNCS_CL
#define PRELIGHT_TRANSPORT_BSDF_FUNCS_CL

#include "transport/adjoint_funcs.cl"
#include "transport/lobe_choice_funcs.cl"
#include "transport/rough_glass_funcs.cl"

// Flag for a set of lobes: each lobe is weighted separately, so that a sample carries light of its lobe alone.
#define PRELIGHT_LOBES_APART 256u

// Light that is scattered to a direction, times its cosine, without that of mirrors and smooth glass.
typedef struct Scattered {
  float3 diffuse;
  float3 glossy;
#ifdef PRELIGHT_LAYERS
  float3 layers;  // coat and sheen; evalBsdf adds it to `glossy`
#endif
} Scattered;

// A sampled direction of scattering.
typedef struct BsdfSample {
  float3 direction;
  float3 weight;  // scattered light over the density of the direction; see carriedBy
  float pdf;      // 1/sr; 0: no other strategy finds the direction, as it comes from a mirror or smooth glass
  float eta2;     // square of the relative index of refraction that radiance has passed; 1 for importance
  uint lobe;      // lobe from which it was drawn
} BsdfSample;

// Returns the throughput after scattering of a path that came with `carried`.
PRELIGHT_INLINE float3 carriedBy(BsdfSample sample, float3 carried) { return carried * sample.weight / sample.eta2; }

// Returns true when light may come from or go to wi, whose cosine with the triangle's own normal is `geometric`. That
// normal and the normal of some lobe must agree on the side, otherwise light would leak through the surface.
PRELIGHT_INLINE bool maySee(Bsdf b, float3 wi, float geometric) {
#ifdef PRELIGHT_TRANSLUCENT
  if (bodyCosine(b, wi) < 0.0f && geometric < 0.0f && largest(b.transmitted) > 0.0f) return true;
#endif
#ifdef PRELIGHT_ROUGH_GLASS
  if (wi.z < 0.0f && geometric < 0.0f) return isRoughGlass(b);
#endif
  return geometric > 0.0f && (wi.z > 0.0f || bodyCosine(b, wi) > 0.0f);
}

// Returns true when wi, for which maySee() is true, is above the surface; `geometric` as there.
PRELIGHT_INLINE bool isAbove(float3 wi, float geometric) {
#ifdef PRELIGHT_BUMPS
  return geometric > 0.0f;
#else
  return wi.z > 0.0f;  // the two agree
#endif
}

// Evaluates scattering between wo, above the surface, and wi, which is below a surface that lets light through or
// above, in the frame of the shading normal. `eye`: the one of the two directions to which light goes.
PRELIGHT_INLINE Scattered evalBase(Bsdf b, float3 wo, float3 wi, bool above, float3 eye) {
  // Light that enters and leaves the body passes the layer twice. Light that the layer holds back on the way out is
  // scattered again, so that under a uniform sky only the body's absorption is lost ([1] of transport/lobe_funcs.cl).
  const float cosine = above ? bodyCosine(b, wi) : -bodyCosine(b, wi);
  const float through = PRELIGHT_INVERSE_PI * b.bodyGain * passage(b, wo) * passage(b, bodyWay(b, wi)) * fmax(cosine, 0.0f);
  const bool onFacets = above ? wi.z > 0.0f : wi.z < 0.0f;
  Scattered r;
  r.glossy = (float3)(0.0f);
#ifdef PRELIGHT_ROUGH_GLASS
  if (onFacets && isRoughGlass(b)) r.glossy = evalRoughGlass(b, wo, wi, eye);
#endif
  if (!above) {
#ifdef PRELIGHT_TRANSLUCENT
    r.diffuse = b.transmitted * through;
#else
    r.diffuse = (float3)(0.0f);
#endif
    return r;
  }
  r.diffuse = b.diffuse * through;
#ifdef PRELIGHT_GLOSSY
  if (onFacets && !b.smooth) r.glossy += evalGlossy(b, wo, wi);
#endif
#ifdef PRELIGHT_MEASURED
  if (isMeasured(b)) {  // at grazing angles less light may leave than the body sends
    r.diffuse = fmax(r.diffuse + fmin(r.glossy, 0.0f), 0.0f);
    r.glossy = fmax(r.glossy, 0.0f);
  }
#endif
  return r;
}

// As evalBase, with the layers of coat and sheen over it.
PRELIGHT_INLINE Scattered evalLobes(Bsdf b, float3 wo, float3 wi, bool above, float3 eye) {
  Scattered r = evalBase(b, wo, wi, above, eye);
#ifdef PRELIGHT_LAYERS
  const float left = leftByLayers(b, eye);
  r.diffuse *= left;
  r.glossy *= left;
  r.layers = above && wi.z > 0.0f ? evalLayers(b, wo, wi, eye) : (float3)(0.0f);
#endif
  return r;
}

// Returns the density of wi over the lobes that are neither mirrors nor smooth glass.
PRELIGHT_INLINE float pdfLobes(Bsdf b, LobeChances c, float3 wo, float3 wi) {
  float density = 0.0f;
#ifdef PRELIGHT_ROUGH_GLASS
  if (isRoughGlass(b) && c.glass > 0.0f) density = c.glass * pdfRoughGlass(b, wo, wi);
#endif
  const float cosine = bodyCosine(b, wi);
#ifdef PRELIGHT_TRANSLUCENT
  if (cosine < 0.0f) density += c.through * PRELIGHT_INVERSE_PI * -cosine;
#endif
#ifdef PRELIGHT_LAYERS
  if (wi.z >= 0.0f) {
    if (c.coat > 0.0f) density += c.coat * pdfCoat(b, wo, wi);
    density += c.sheen * PRELIGHT_INVERSE_PI * wi.z;
  }
#endif
  if (cosine > 0.0f) density += c.diffuse * PRELIGHT_INVERSE_PI * cosine;
  if (wi.z < 0.0f) return density;
#ifdef PRELIGHT_GLOSSY
  if (!b.smooth && c.specular > 0.0f) density += c.specular * pdfGlossy(b, wo, wi);
#endif
  return density;
}

// Returns the square of the relative index of refraction for radiance that a rough surface scatters to a direction
// above or below.
PRELIGHT_INLINE float passedIndex2(Bsdf b, bool above) {
#ifdef PRELIGHT_ROUGH_GLASS
  if (!above && isRoughGlass(b) && b.solid) return b.eta * b.eta;
#endif
  return 1.0f;
}

// Returns the BSDF as one mode uses it. To the eye, diffuse scattering off a bump looks alike from everywhere: so light
// traced from a source arrives with the bump's normal, none from behind it, and leaves with the triangle's own.
PRELIGHT_INLINE Bsdf asFoundBy(uint mode, Interaction i, Bsdf b) {
#ifdef PRELIGHT_BUMPS
  if (mode == PRELIGHT_IMPORTANCE && b.bumped) {
    const float arrives = fmax(dot(i.wo, i.body), 0.0f) / fmax(dot(i.wo, i.geometric), 1e-6f);
    b.diffuse *= fmin(arrives, PRELIGHT_MOST_ADJOINT);
#ifdef PRELIGHT_TRANSLUCENT
    b.transmitted *= fmin(arrives, PRELIGHT_MOST_ADJOINT);
#endif
    b.body = toFrame(i.frame, i.geometric);
  }
#endif
  return b;
}

// Returns adjointRatio() for diffuse scattering.
PRELIGHT_INLINE float bodyAdjointRatio(Interaction i, Bsdf b, float3 direction) {
#ifdef PRELIGHT_BUMPS
  if (b.bumped) return 1.0f;  // asFoundBy() has applied it
#endif
  return adjointRatio(i, direction);
}

// Evaluates the BSDF. Radiance: light comes from `direction` and leaves to i.wo. Importance: it comes from i.wo and
// leaves to `direction`. Returns false when there is none.
PRELIGHT_INLINE bool evalBsdf(Interaction i, Bsdf b, float3 direction, uint mode, Scattered* scattered) {
  b = asFoundBy(mode, i, b);
  const float3 wi = toFrame(i.frame, direction);
  const float geometric = dot(direction, i.geometric);
  if (i.woLocal.z <= 0.0f || !maySee(b, wi, geometric)) return false;
  const bool above = isAbove(wi, geometric);
  *scattered = evalLobes(b, i.woLocal, wi, above, mode == PRELIGHT_IMPORTANCE ? wi : i.woLocal);
#ifdef PRELIGHT_LAYERS
  scattered->glossy += scattered->layers;
#endif
  if (mode == PRELIGHT_RADIANCE) scattered->glossy /= passedIndex2(b, above);
  if (mode == PRELIGHT_IMPORTANCE) {
    scattered->diffuse *= bodyAdjointRatio(i, b, direction);
    scattered->glossy *= adjointRatio(i, direction);
  }
  return true;
}

// Returns the density, 1/sr, with which sampleBsdf draws a direction for which evalBsdf finds radiance.
PRELIGHT_INLINE float pdfBsdf(Interaction i, Bsdf b, float3 direction, uint lobes) {
  return pdfLobes(b, lobeChances(b, i.woLocal, lobes), i.woLocal, toFrame(i.frame, direction));
}

// Returns the weight of a sample. `value`: scattered light; `density`: that of the choice that led to it.
PRELIGHT_INLINE float3 sampleWeight(Interaction i, float3 direction, uint mode, float3 value, float density) {
  return mode == PRELIGHT_IMPORTANCE ? value * (adjointRatio(i, direction) / density) : value / density;
}

#ifdef PRELIGHT_MIRROR
PRELIGHT_INLINE bool sampleMirror(Interaction i, Bsdf b, uint mode, float chance, BsdfSample* sample) {
  sample->direction = fromFrame(i.frame, (float3)(-i.woLocal.x, -i.woLocal.y, i.woLocal.z));
  if (dot(sample->direction, i.geometric) <= 0.0f) return false;
  float3 value = specularAlbedo(b, i.woLocal);
#ifdef PRELIGHT_LAYERS
  value *= leftByLayers(b, i.woLocal);
#endif
  sample->weight = sampleWeight(i, sample->direction, mode, value, chance);
  sample->lobe = PRELIGHT_LOBE_MIRROR;
  return true;
}
#endif

#ifdef PRELIGHT_LAYERS
PRELIGHT_INLINE bool sampleCoatMirror(Interaction i, Bsdf b, uint mode, float chance, BsdfSample* sample) {
  const float cosine = coatCosine(b, i.woLocal);
  const float3 wi = 2.0f * cosine * b.coatNormal - i.woLocal;
  sample->direction = fromFrame(i.frame, wi);
  if (wi.z <= 0.0f || dot(sample->direction, i.geometric) <= 0.0f) return false;
  const float bent = mode == PRELIGHT_IMPORTANCE ? wi.z / i.woLocal.z : 1.0f;
  const float3 value = (float3)(b.coat * coatReflectance(cosine) * bent);
  sample->weight = sampleWeight(i, sample->direction, mode, value, chance);
  sample->lobe = PRELIGHT_LOBE_MIRROR;
  return true;
}
#endif

// As sampleWeight, for lobes of several normals. `body`: the diffuse part of `value`.
PRELIGHT_INLINE float3 mixedWeight(Interaction i, Bsdf b, float3 direction, uint mode, float3 value, float3 body, float density) {
#ifdef PRELIGHT_BUMPS
  if (mode == PRELIGHT_IMPORTANCE && b.bumped) return ((value - body) * adjointRatio(i, direction) + body) / density;
#endif
  return sampleWeight(i, direction, mode, value, density);
}

// Returns the part of the scattered light f that belongs to one lobe other than PRELIGHT_LOBE_THROUGH, and the density
// with which sampleBsdf draws wi from it. Coat and sheen count as one lobe.
PRELIGHT_INLINE float3 scatteredApart(Bsdf b, LobeChances chances, uint lobe, Scattered f, float3 wo, float3 wi, float3 eye,
                                      float* density) {
#ifdef PRELIGHT_LAYERS
  if ((lobe & PRELIGHT_LOBES_LAYERS) != 0u) {
    LobeChances layers = {0.0f, 0.0f, 0.0f};
    layers.coat = chances.coat;
    layers.sheen = chances.sheen;
    *density = pdfLobes(b, layers, wo, wi);
    return f.layers;
  }
#endif
  const bool diffuse = lobe == PRELIGHT_LOBE_DIFFUSE, glass = (lobe & PRELIGHT_LOBES_GLASS) != 0u;
  float3 value = diffuse ? f.diffuse : f.glossy;
#ifdef PRELIGHT_ROUGH_GLASS
  if (isRoughGlass(b) && !diffuse) {
    const float3 ofGlass = evalRoughGlass(b, wo, wi, eye) * leftByLayers(b, eye);
    value = glass ? ofGlass : f.glossy - ofGlass;
  }
#endif
  const LobeChances one = {diffuse ? 1.0f : 0.0f, diffuse || glass ? 0.0f : 1.0f, glass ? 1.0f : 0.0f};
  *density = pdfLobes(b, one, wo, wi) * (diffuse ? chances.diffuse : (glass ? chances.glass : chances.specular));
  return value;
}

// Returns the scattered light that a sample from `lobe` carries, and its density. body: the diffuse part of that light.
PRELIGHT_INLINE float3 carriedBySample(Bsdf b, LobeChances chances, uint lobe, bool apart, float3 wo, float3 wi, bool above,
                                       float3 eye, float3* body, float* density) {
  const Scattered f = evalLobes(b, wo, wi, above, eye);
  if (apart && lobe != PRELIGHT_LOBE_THROUGH) {
    *body = lobe == PRELIGHT_LOBE_DIFFUSE ? f.diffuse : (float3)(0.0f);
    return scatteredApart(b, chances, lobe, f, wo, wi, eye, density);
  }
  // A lobe from which no sample is drawn leaves its light to the others.
#ifdef PRELIGHT_ROUGH_GLASS
  const bool sharp = chances.specular > 0.0f || (chances.glass > 0.0f && isRoughGlass(b));
#else
  const bool sharp = chances.specular > 0.0f;
#endif
  *body = !above || chances.diffuse > 0.0f ? f.diffuse * passedIndex2(b, above) : (float3)(0.0f);
  float3 value = (!above || chances.diffuse > 0.0f ? f.diffuse * passedIndex2(b, above) : (float3)(0.0f)) +
                 (sharp ? f.glossy : (float3)(0.0f));
  *density = pdfLobes(b, chances, wo, wi);
#ifdef PRELIGHT_LAYERS
  if (chances.coat + chances.sheen > 0.0f) value += f.layers;
#endif
  return value;
}

// Draws a direction from one of the lobes that scatter to all directions, and writes the side for glass. `chance`: the
// rest, in [0,1), of the random number that has chosen the lobe. Returns false when there is no direction.
PRELIGHT_INLINE bool drawFromLobe(Bsdf b, float3 wo, float chance, float2 u, uint* lobe, float3* wi) {
#ifdef PRELIGHT_ROUGH_GLASS
  if ((*lobe & PRELIGHT_LOBES_GLASS) != 0u) {
    const bool found = sampleRoughGlass(b, wo, chance, u, wi);
    if (wi->z > 0.0f) *lobe = PRELIGHT_LOBE_GLASS_REFLECTION;
    return found;
  }
#endif
#ifdef PRELIGHT_LAYERS
  if (*lobe == PRELIGHT_LOBE_COAT) {
    *wi = sampleCoat(b, u, wo);
    return wi->z > 0.0f;
  }
#endif
#ifdef PRELIGHT_GLOSSY
  if (*lobe == PRELIGHT_LOBE_GLOSSY) {
    *wi = sampleGlossy(b, chance, u, wo);
    return wi->z > 0.0f;
  }
#endif
  *wi = sampleCosineHemisphere(u, *lobe == PRELIGHT_LOBE_SHEEN ? (float3)(0.0f, 0.0f, 1.0f) : bodyNormal(b));
  const bool found = *lobe == PRELIGHT_LOBE_SHEEN ? wi->z > 0.0f : bodyCosine(b, *wi) > 0.0f;
  if (*lobe == PRELIGHT_LOBE_THROUGH) *wi = beyondBody(b, *wi);
  return found;
}

// Samples one of the lobes that scatter to all directions; `chance` as in drawFromLobe. Returns false when there is no
// direction.
PRELIGHT_INLINE bool sampleRough(Interaction i, Bsdf b, uint lobes, uint mode, LobeChances chances, uint lobe, float chance,
                                 float2 u, BsdfSample* sample) {
  float3 wi;
  if (!drawFromLobe(b, i.woLocal, chance, u, &lobe, &wi)) return false;
  sample->direction = fromFrame(i.frame, wi);
  const float geometric = dot(sample->direction, i.geometric);
  if (!maySee(b, wi, geometric)) return false;
  const bool above = isAbove(wi, geometric);
  float3 body;
  const float3 value =
      carriedBySample(b, chances, lobe, (lobes & PRELIGHT_LOBES_APART) != 0u, i.woLocal, wi, above,
                      mode == PRELIGHT_IMPORTANCE ? wi : i.woLocal, &body, &sample->pdf);
  if (!(sample->pdf > 0.0f)) return false;
  sample->weight = mixedWeight(i, b, sample->direction, mode, value, body, sample->pdf);
  if (mode == PRELIGHT_RADIANCE) sample->eta2 = passedIndex2(b, above);
  sample->lobe = lobe;
  return true;
}

// Draws the direction of a path that has come along i.wo, from one of `lobes` in proportion to what they scatter.
// `chance` picks the lobe, u the direction, both in [0,1). The path gathers radiance, or it carries importance (or the
// power of a photon). Returns false when it ends.
PRELIGHT_INLINE bool sampleBsdf(Interaction i, Bsdf b, uint lobes, uint mode, float chance, float2 u, BsdfSample* sample) {
  b = asFoundBy(mode, i, b);
  const LobeChances chances = lobeChances(b, i.woLocal, lobes);
  if (!(chanceSum(chances) > 0.0f)) return false;
  sample->pdf = 0.0f;
  sample->eta2 = 1.0f;
  const bool through = picksThrough(chances, &chance);
#ifdef PRELIGHT_LAYERS
  if (!through) {
    if (chance < chances.coat)
      return b.coatSmooth ? sampleCoatMirror(i, b, mode, chances.coat, sample)
                          : sampleRough(i, b, lobes, mode, chances, PRELIGHT_LOBE_COAT, 0.0f, u, sample);
    chance -= chances.coat;
    if (chance < chances.sheen) return sampleRough(i, b, lobes, mode, chances, PRELIGHT_LOBE_SHEEN, 0.0f, u, sample);
    chance -= chances.sheen;
  }
#endif
#ifdef PRELIGHT_GLASS
  if (chance >= chances.diffuse + chances.specular) {
    // The rest of the random number that has chosen the lobe decides between reflection and transmission.
    const float rest = clamp((chance - chances.diffuse - chances.specular) / chances.glass, 0.0f, 0.99999994f);
#ifdef PRELIGHT_ROUGH_GLASS
    if (isRoughGlass(b))
      return i.woLocal.z > 0.0f && sampleRough(i, b, lobes, mode, chances, PRELIGHT_LOBE_GLASS_TRANSMISSION, rest, u, sample);
#endif
    GlassSample glass;
    if (!sampleGlass(i, b, mode, rest, &glass)) return false;
    sample->direction = glass.direction;
    sample->weight = glass.weight * (b.glass / chances.glass);
#ifdef PRELIGHT_LAYERS
    sample->weight *= leftByLayers(b, i.woLocal);
#endif
    sample->eta2 = glass.eta2;
    sample->lobe = glass.passes ? PRELIGHT_LOBE_GLASS_TRANSMISSION : PRELIGHT_LOBE_GLASS_REFLECTION;
    return true;
  }
#endif
  const bool specular = chance >= chances.diffuse;
#ifdef PRELIGHT_MIRROR
  if (specular && b.smooth) return sampleMirror(i, b, mode, chances.specular, sample);
#endif
  const float rest = specular ? clamp((chance - chances.diffuse) / chances.specular, 0.0f, 0.99999994f) : 0.0f;
  const uint lobe = through ? PRELIGHT_LOBE_THROUGH : (specular ? PRELIGHT_LOBE_GLOSSY : PRELIGHT_LOBE_DIFFUSE);
  return sampleRough(i, b, lobes, mode, chances, lobe, rest, u, sample);
}

#endif
