// Steps of a path where it meets a surface: collect emitted light, sample lights, scatter.
// Options: those of the included files, PRELIGHT_DIFFUSE_BOUNCES (the most that a path may have; undefined: any
// number), PRELIGHT_NO_GLOSSY_BOUNCES, PRELIGHT_ABSORPTION (some glass absorbs), PRELIGHT_LIGHT_CANDIDATES (light
// samples from which one is chosen; undefined: one, and sampleLightAt accepts single punctual lights too).
#ifndef PRELIGHT_REFERENCE_PATH_POINT_FUNCS_CL
#define PRELIGHT_REFERENCE_PATH_POINT_FUNCS_CL

#include "integrate/path_funcs.cl"
#include "transport/dispersion_funcs.cl"
#include "transport/medium_funcs.cl"
#include "transport/roulette_funcs.cl"
#include "transport/straight_funcs.cl"

// Number of panes that a path may pass: a bound against scenes that stack any number of them.
#define PRELIGHT_MOST_PANES 4096u

// The surface point that a path has met, and its BSDF.
typedef struct PathPoint {
  Interaction surface;
  Bsdf bsdf;
  uint path;  // number of the path
} PathPoint;

PRELIGHT_INLINE PathPoint pathPointAt(PathScene s, Interaction surface, uint path) {
  const PathPoint at = {surface, loadBsdf(s, surface), path};
  return at;
}

#ifdef PRELIGHT_DISPERSION
PRELIGHT_INLINE float waveOf(__constant const ReferenceParameters* p, uint path) {
  return pathPoint(p, path, PRELIGHT_PAIR_WAVELENGTH).x;
}
#endif

// Returns the path point with its BSDF dispersed at the path's wavelength.
PRELIGHT_INLINE PathPoint dispersedAt(__constant const ReferenceParameters* p, PathScene s, PathPoint at, PathState path) {
#ifdef PRELIGHT_DISPERSION
  disperse(s, at.surface, waveOf(p, at.path), path.dispersed != 0u, &at.bsdf);
#endif
  return at;
}

// Returns the number of a path's segments before the one that ends at vertex `depth`. Panes do not count.
PRELIGHT_INLINE uint segmentsBefore(uint depth, PathState path) {
#ifdef PRELIGHT_PANES
  return depth - path.panes;
#else
  return depth;
#endif
}

// Returns true when a path may have no further segment. With panes the kernels find out; otherwise the host stops in
// time.
PRELIGHT_INLINE bool isComplete(__constant const ReferenceParameters* p, uint depth, PathState path) {
#ifdef PRELIGHT_PANES
  return segmentsBefore(depth, path) + 1u >= p->mostSegments;
#else
  return false;
#endif
}

// Returns the lobes by which a path may still go on.
PRELIGHT_INLINE uint lobesOf(PathState path) {
  uint lobes = PRELIGHT_LOBES_ALL;
#ifdef PRELIGHT_DIFFUSE_BOUNCES
  if (path.diffuseBounces >= PRELIGHT_DIFFUSE_BOUNCES) lobes &= ~PRELIGHT_LOBES_DIFFUSE;
#endif
#ifdef PRELIGHT_NO_GLOSSY_BOUNCES
  lobes &= ~PRELIGHT_LOBE_GLOSSY;
#endif
  return lobes;
}

// Adds the radiance that the surface or the sky emits along a ray, and applies the absorption of glass. surface: where
// the ray hits.
PRELIGHT_INLINE void collectAt(__constant const ReferenceParameters* p, uint depth, PathScene s, Lights lights, Ray ray,
                               Hit hit, Interaction surface, PathState* path) {
  const float scattered = path->scatterDensity;
  float3 throughput = vload3(0, path->throughput);
  float cosine = 1.0f;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) {
    cosine = dot(surface.wo, surface.geometric);
#ifdef PRELIGHT_ABSORPTION
    const uint medium = mediumBefore(surface, path->medium);
    if (absorbsOnly(s, medium)) {
      throughput *= transmittance(s, medium, hit.t);
      vstore3(throughput, 0, path->throughput);
    }
#endif
  }
#ifdef PRELIGHT_LEAST_DEPTH
  if (segmentsBefore(depth, *path) + 1u < PRELIGHT_LEAST_DEPTH) return;
#endif
  // The surface must not be read without a hit: compilers take such a read as proof that there is one.
  const bool front = hit.triangle != PRELIGHT_NO_TRIANGLE && surface.front;
  float3 radiance = evalLight(lights, &p->scene.lights, s, ray, hit, front);
  if (depth == 0u && hit.triangle != PRELIGHT_NO_TRIANGLE && (surface.flags & PRELIGHT_UNLIT) != 0u)
    radiance = baseColor(s, hit.triangle, hit.u, hit.v);
  float weight = 1.0f;
  if (scattered > 0.0f) {
#if defined(PRELIGHT_LIGHTS_ONLY)
    weight = 0.0f;
#elif !defined(PRELIGHT_SCATTER_ONLY)
    hit.t += path->behind;  // the direction was drawn that far behind
    weight = misWeight(scattered, pdfLight(lights, &p->scene.lights, ray, hit, cosine));
#endif
  }
  vstore3(vload3(0, path->radiance) + weight * throughput * radiance, 0, path->radiance);
}

// Returns the radiance that a light sample brings along the path if it is not occluded.
PRELIGHT_INLINE float3 arrivingBy(__constant const ReferenceParameters* p, PathScene s, PathPoint at, PathState path, LightSample a) {
  Scattered f;
  if (!evalBsdf(at.surface, at.bsdf, a.direction, PRELIGHT_RADIANCE, &f)) return (float3)(0.0f);
  float3 reflected = f.diffuse + f.glossy;
#ifndef PRELIGHT_LIGHTS_ONLY
  if (!a.punctual) {
#ifdef PRELIGHT_SCATTER_ONLY
    return (float3)(0.0f);
#else
    // Light of a lobe that no ray follows is found by this sample alone.
    const uint lobes = lobesOf(path);
    const float weight = misWeight(a.pdf, pdfBsdf(at.surface, at.bsdf, a.direction, lobes));
    reflected = (lobes & PRELIGHT_LOBES_DIFFUSE) != 0u ? reflected * weight : f.diffuse + f.glossy * weight;
#endif
  }
#endif
  float3 radiance = vload3(0, path.throughput) * reflected * a.radiance / a.pdf;
#ifdef PRELIGHT_DISPERSION
  if (path.dispersed == 0u && splitsAsAWhole(at.bsdf) && takesColor(s, at.surface, at.bsdf, 0u))
    radiance *= colorOfWave(waveOf(p, at.path));
#endif
#ifdef PRELIGHT_ABSORPTION
  const uint medium = mediumTowards(at.surface, a.direction, path.medium);
  if (medium != PRELIGHT_NO_MEDIUM) radiance *= transmittance(s, medium, a.distance);
#endif
  return radiance;
}

#ifdef PRELIGHT_LIGHT_CANDIDATES
// The lights of one kind, whose samples are compared with one another.
typedef struct LightStratum {
  uint first, width;  // of the bits that choose a light, in 2^32; width 0: all of them
  uint candidates;
  float weight;  // of its samples
} LightStratum;

// Chooses a kind of lights for a path, half by power and half evenly: punctual lights, emitters, or the sky. Compared
// with what the sun would bring without anything in between, the light of the sky or of a lamp would hardly ever be
// chosen where the sun is hidden, and then count as much as the sun's.
PRELIGHT_INLINE LightStratum chooseStratum(__global const uint* bounds, __constant const LightLayout* layout, float chance) {
  uint sky = layout->emitterGroup;  // the order of groups is that of sampleLight
#ifdef PRELIGHT_EMITTERS
  ++sky;
#endif
  const uint ends[3] = {layout->emitterGroup, sky, layout->groupCount};
  uint kinds = 0u;
  for (uint kind = 0u, first = 0u; kind < 3u; first = ends[kind++]) kinds += first < ends[kind] ? 1u : 0u;
  LightStratum chosen;
  for (uint kind = 0u, first = 0u; kind < 3u; first = ends[kind++]) {
    if (first == ends[kind]) continue;
    const uint end = ends[kind] < layout->groupCount ? bounds[ends[kind]] : 0u;
    chosen.first = bounds[first];
    chosen.width = end - bounds[first];
    const float part = kinds == 1u ? 1.0f : (float)chosen.width * 2.3283064e-10f;
    const float share = 0.5f * part + 0.5f / (float)kinds;
    chosen.weight = part / share;
    chosen.candidates = kind == 0u && ends[0] == 1u ? 1u : PRELIGHT_LIGHT_CANDIDATES;
    if (chance < share) break;
    chance -= share;
  }
  return chosen;
}

// Chooses one of several samples of a stratum's lights in proportion to the light that each would bring, and writes the
// mean of that light (resampled importance sampling: Talbot, Cline and Egbert 2005). Sky samples are drawn without
// regard to the surface, so many lie behind it.
PRELIGHT_INLINE bool chooseLightAt(__constant const ReferenceParameters* p, uint depth, PathScene s, Lights lights,
                                   PathPoint at, PathState path, LightSample* chosen, float3* arriving) {
  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const float2 chances = pathPoint(p, at.path, pair + PRELIGHT_PAIR_CANDIDATE);
  const LightStratum stratum = chooseStratum(lights.tables, &p->scene.lights, chances.y);
  float chance = chances.x;
  float sum = 0.0f, share = 0.0f;
#pragma unroll 1  // compiling four copies takes longer than they save
  for (uint i = 0; i < stratum.candidates; ++i) {
    uint2 choice = finerPathBits(p, at.path, pair + PRELIGHT_PAIR_LIGHT, stratum.candidates, i);
    const uint2 place = finerPathBits(p, at.path, pair + PRELIGHT_PAIR_PLACE, stratum.candidates, i);
    if (stratum.width > 0u) choice.x = stratum.first + mul_hi(choice.x, stratum.width);
    LightSample a;
    if (!sampleLight(lights, &p->scene.lights, s, at.surface.position, choice, place, &a)) continue;
    const float3 radiance = arrivingBy(p, s, at, path, a);
    const float weight = radiance.x + radiance.y + radiance.z;
    if (!(weight > 0.0f)) continue;
    sum += weight;
    const float taken = weight / sum;
    if (chance < taken) {
      chance /= taken;
      share = weight;
      *chosen = a;
      *arriving = radiance;
    } else {
      chance = (chance - taken) / (1.0f - taken);
    }
  }
  if (!(share > 0.0f)) return false;
  *arriving *= stratum.weight * sum / (share * (float)stratum.candidates);
  return true;
}
#endif

// Samples light that may arrive directly: that of punctual light `light` if it is below groupCount, otherwise of a
// random light. Returns false when there is none.
PRELIGHT_INLINE bool sampleLightAt(__constant const ReferenceParameters* p, uint depth, PathScene s, Lights lights,
                                   PathPoint at, PathState path, uint light, Ray* shadow, float3* arriving) {
  if (!isDiffuse(at.bsdf) && !isGlossy(at.bsdf)) return false;
  if (at.surface.woLocal.z <= 0.0f || isComplete(p, depth, path)) return false;
#if defined(PRELIGHT_PANES) && defined(PRELIGHT_LEAST_DEPTH)
  if (segmentsBefore(depth, path) + 2u < PRELIGHT_LEAST_DEPTH) return false;
#endif

  LightSample a;
#ifdef PRELIGHT_LIGHT_CANDIDATES
  if (!chooseLightAt(p, depth, s, lights, at, path, &a, arriving)) return false;
#else
  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const uint2 choice = pathBits(p, at.path, pair + PRELIGHT_PAIR_LIGHT);
  const uint2 place = pathBits(p, at.path, pair + PRELIGHT_PAIR_PLACE);
  bool arrives = false;
#ifdef PRELIGHT_PUNCTUAL
  if (light != PRELIGHT_NO_TRIANGLE) arrives = samplePunctual(lights, light, at.surface.position, (float2)(unitFloat(place.x), unitFloat(place.y)), &a);
#endif
  if (light == PRELIGHT_NO_TRIANGLE) arrives = sampleLight(lights, &p->scene.lights, s, at.surface.position, choice, place, &a);
  if (!arrives) return false;
  *arriving = arrivingBy(p, s, at, path, a);
  if (largest(*arriving) <= 0.0f) return false;
#endif
  *shadow = a.surface ? rayTo(at.surface, a.direction, a.target, 0.99998f) : rayFrom(at.surface, a.direction, a.distance);
  return true;
}

// Takes a path that has come over `way` metres through a pane. Returns false when it has passed too many.
PRELIGHT_INLINE bool notePane(float way, PathState* path) {
  path->behind += way;
  return path->panes++ < PRELIGHT_MOST_PANES;
}

// Notes that a path which has come over `way` metres has scattered or passed a pane. Returns false when it may not go
// on.
PRELIGHT_INLINE bool noteScattering(__constant const ReferenceParameters* p, uint depth, PathPoint at, BsdfSample sample, float way,
                                    PathState* path) {
  if (goesStraight(at.surface, at.bsdf, sample.lobe)) return notePane(way, path);
  if (isComplete(p, depth, *path)) return false;
  path->scatterDensity = sample.pdf;
  path->behind = 0.0f;
  return true;
}

// Draws the direction in which a path that has come over `way` metres goes on. Returns false when it ends.
PRELIGHT_INLINE bool scatterAt(__constant const ReferenceParameters* p, uint depth, PathScene s, PathPoint at, float way,
                               PathState* path, Ray* next) {
  const uint pair = depth * PRELIGHT_PAIRS_A_VERTEX;
  const float2 chance = pathPoint(p, at.path, pair + PRELIGHT_PAIR_LOBE);
  const float2 u = pathPoint(p, at.path, pair + PRELIGHT_PAIR_DIRECTION);
  BsdfSample sample;
  if (!sampleBsdf(at.surface, at.bsdf, lobesOf(*path), PRELIGHT_RADIANCE, chance.x, u, &sample)) return false;
  if (!noteScattering(p, depth, at, sample, way, path)) return false;
  if ((sample.lobe & PRELIGHT_LOBES_DIFFUSE) != 0u) ++path->diffuseBounces;
  float3 throughput = carriedBy(sample, vload3(0, path->throughput));
#ifdef PRELIGHT_DISPERSION
  if (path->dispersed == 0u && takesColor(s, at.surface, at.bsdf, sample.lobe)) {
    throughput *= colorOfWave(waveOf(p, at.path));
    path->dispersed = 1u;
  }
#endif
  path->relativeIor2 *= sample.eta2;
  const float strength = largest(throughput) * path->relativeIor2;
  if (!(strength > 0.0f)) return false;
  // Paths without losses go on; the depth limit ends them.
  if (!survives(depth < p->rouletteDepth ? 1.0f : fmin(strength, 1.0f), chance.y, &throughput)) return false;
  vstore3(throughput, 0, path->throughput);
  if (sample.pdf > 0.0f) path->seesWalls = 1u;
  path->medium = mediumAfter(at.surface, sample.lobe, path->medium);
  *next = rayFrom(at.surface, normalize(sample.direction), MAXFLOAT);
  return true;
}

#endif
