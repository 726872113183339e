// Final gathering: a receiver's cosine-weighted rays look up the light that diffuse surfaces send. Rays are followed
// through mirrors, glass and glossy lobes to such surfaces. Lamps and the sky count only behind a lobe that is not
// narrow: seen directly they are direct light, and through narrow lobes alone they are caustics.
//   [trace -> gatherRadiance -> askLights -> trace -> addArrivals] ... -> sumRadiance
// Options: those of the included files, PRELIGHT_ABSORPTION (some glass absorbs), PRELIGHT_FOLLOWS (some surface has
// lobes that are not diffuse).
#include "core/sampling_funcs.cl"
#include "core/shadow_share_funcs.cl"
#include "gather/gather_light_funcs.cl"
#include "gather/irradiance_map_funcs.cl"
#include "shared/cast_types.h"
#include "transport/dispersion_funcs.cl"
#include "transport/irradiance_funcs.cl"
#include "transport/medium_funcs.cl"
#include "transport/roulette_funcs.cl"
#include "transport/straight_funcs.cl"

// Pairs of random numbers per surface: lobe and roulette, direction.
#define PRELIGHT_GATHER_PAIRS 3u
// First pair of the random numbers for lights, beyond those of all surfaces: group and emitter, place, roulette.
#define PRELIGHT_PAIR_LIGHTS 0x20000u

// Returns pair `pair` at surface `depth` of the receiver's own sequence, independent of the other receivers of the
// launch.
uint2 gatherBits(__constant const GatherParameters* p, __global const Receiver* receivers, uint ray, uint depth, uint pair) {
  const uint receiver = ray / p->raysPerReceiver;
  const uint sample = receivers[receiver].firstSample + ray % p->raysPerReceiver;
  const uint dimension = hashInteger(p->seed + (depth * PRELIGHT_GATHER_PAIRS + pair) * 0x9e3779b9u);
  return samplePaddedBits(sample, hashInteger(receivers[receiver].seed ^ dimension));
}

float2 gatherPoint(__constant const GatherParameters* p, __global const Receiver* receivers, uint ray, uint depth, uint pair) {
  const uint2 bits = gatherBits(p, receivers, ray, depth, pair);
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

// Returns the path of a ray; before the first surface it is a new one.
PRELIGHT_INLINE GatherPath gatherPathAt(GatherStep step, __global const GatherPath* paths, uint i) {
  const GatherPath first = {{1.0f, 1.0f, 1.0f}, 1.0f, PRELIGHT_NO_MEDIUM, i, 0.0f, 0u, 0.0f};
  return step.depth > 0u ? paths[i] : first;
}

// Loads the BSDF at a surface. Attenuates the path by the glass that it has crossed, and disperses the BSDF by the
// path's wavelength.
PRELIGHT_INLINE Bsdf meetSurface(__constant const GatherParameters* p, __global const Receiver* receivers, PathScene s,
                                 Interaction surface, float way, GatherPath* path) {
  Bsdf b = loadBsdf(s, surface);
#ifdef PRELIGHT_ABSORPTION
  const uint medium = mediumBefore(surface, path->medium);
  if (medium != PRELIGHT_NO_MEDIUM) vstore3(vload3(0, path->throughput) * unabsorbed(s, medium, way), 0, path->throughput);
#endif
#ifdef PRELIGHT_DISPERSION
  const float wave = gatherPoint(p, receivers, path->ray, 0u, PRELIGHT_PAIR_WAVELENGTH).x;
  disperse(s, surface, wave, (path->flags & PRELIGHT_GATHER_DISPERSED) != 0u, &b);
#endif
  return b;
}

#ifdef PRELIGHT_FOLLOWS
// Continues a ray from a surface by one of its lobes that are not diffuse. Returns false when it ends there.
PRELIGHT_INLINE bool follow(__constant const GatherParameters* p, __global const Receiver* receivers, PathScene s,
                            Interaction surface, Bsdf b, uint depth, float way, GatherPath* path, Ray* next) {
  const float2 chance = gatherPoint(p, receivers, path->ray, depth, 0u), u = gatherPoint(p, receivers, path->ray, depth, 1u);
  const uint lobes = (PRELIGHT_LOBES_ALL & ~PRELIGHT_LOBES_DIFFUSE) | PRELIGHT_LOBES_APART;
  BsdfSample sample;
  if (!sampleBsdf(surface, b, lobes, PRELIGHT_RADIANCE, chance.x, u, &sample)) return false;
  if (goesStraight(surface, b, sample.lobe)) {
    path->behind += way;
  } else {
    const bool asked = asksFor(b, sample.lobe, path->flags, toFrame(surface.frame, sample.direction).z);
    path->scatterDensity = asked ? sample.pdf : 0.0f;
    path->behind = 0.0f;
    if ((sample.lobe & narrowLobes(b)) == 0u) path->flags |= PRELIGHT_GATHER_WIDENED;
  }
  float3 throughput = carriedBy(sample, vload3(0, path->throughput));
#ifdef PRELIGHT_DISPERSION
  if ((path->flags & PRELIGHT_GATHER_DISPERSED) == 0u && takesColor(s, surface, b, sample.lobe)) {
    throughput *= colorOfWave(gatherPoint(p, receivers, path->ray, 0u, PRELIGHT_PAIR_WAVELENGTH).x);
    path->flags |= PRELIGHT_GATHER_DISPERSED;
  }
#endif
  path->relativeIor2 *= sample.eta2;
  float survival = fmin(largest(throughput) * path->relativeIor2, 1.0f);
  if (depth >= p->longWay) survival *= 0.5f;
  if (!survives(survival, chance.y, &throughput)) return false;
  vstore3(throughput, 0, path->throughput);
  path->medium = mediumAfter(surface, sample.lobe, path->medium);
  *next = rayFrom(surface, normalize(sample.direction), MAXFLOAT);
  return true;
}
#endif

// Returns the light of lamps and of the sky that the ray meets by chance; 0 unless a lobe on the path was wide.
PRELIGHT_INLINE float3 metLight(__constant const GatherParameters* p, Scene scene, GatherPath path, Ray ray, Hit hit,
                                bool front, float cosine) {
  if ((path.flags & PRELIGHT_GATHER_WIDENED) == 0u) return (float3)(0.0f);
  const float3 radiance = evalLight(scene.lights, &p->scene.lights, scene.surface, ray, hit, front);
#ifdef PRELIGHT_ASKS_LIGHTS
  hit.t += path.behind;  // the direction was drawn that far behind
  if (path.scatterDensity > 0.0f)
    return radiance * misWeight(path.scatterDensity, pdfLight(scene.lights, &p->scene.lights, ray, hit, cosine));
#endif
  return radiance;
}

// One work-item per ray. At depth 0 it is the ray's first surface, and paths are not read. receivers [receiver of the
// block]; rays, paths and hits [count]; radiances [ray of the block][3] are set at depth 0 and added to beyond -> rays
// and paths of the rays that go on, in the same places from step.next on, and marks.
__kernel void gatherRadiance(__constant const GatherParameters* p, const GatherStep step,
                             __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                             __global const LightLine* lightLines, __global const IrradianceLine* irradiances,
                             __global const Receiver* receivers, __global Ray* rays, __global const Hit* hits,
                             __global GatherPath* paths, __global float* radiances, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const PathScene s = scene.surface;
  const IrradianceMap map = irradianceMapOf(&p->map, irradiances);
  GatherPath path = gatherPathAt(step, paths, (uint)i);
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  marks[i] = 0;
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(s, ray, hit);
  // Without a hit there is no surface to read.
  const bool front = hit.triangle != PRELIGHT_NO_TRIANGLE && surface.front;
  const float cosine = hit.triangle != PRELIGHT_NO_TRIANGLE ? dot(surface.wo, surface.geometric) : 1.0f;
  float3 radiance = metLight(p, scene, path, ray, hit, front, cosine);
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) {
    const Bsdf bsdf = meetSurface(p, receivers, s, surface, hit.t, &path);
    if (largest(bsdf.diffuse) > 0.0f)
      radiance += reflectIrradiance(bsdf, surface.woLocal, irradianceAt(map, hit.triangle, surface.front, hit.u, hit.v));
#ifdef PRELIGHT_TRANSLUCENT
    if (largest(bsdf.transmitted) > 0.0f)
      radiance += transmitIrradiance(bsdf, surface.woLocal, irradianceAt(map, hit.triangle, !surface.front, hit.u, hit.v));
#endif
    radiance *= vload3(0, path.throughput);
#ifdef PRELIGHT_FOLLOWS
    Ray next;
    if (follow(p, receivers, s, surface, bsdf, step.depth, hit.t, &path, &next)) {
      rays[step.next + i] = next;
      paths[step.next + i] = path;
      marks[i] = 1u << PRELIGHT_GATHER_NEXT;
    }
#endif
  } else {
    radiance *= vload3(0, path.throughput);
  }
  __global float* out = radiances + 3 * (size_t)path.ray;
  vstore3(step.depth == 0u ? radiance : vload3(0, out) + radiance, 0, out);
}

#ifdef PRELIGHT_ASKS_LIGHTS
// One work-item per ray, before the rays that go on are moved: samples a light whose light rough lobes may reflect
// along the ray. Lights are sampled with the probability with which these lobes are followed. -> shadow rays, arrivals
// [ray], and marks.
__kernel void askLights(__constant const GatherParameters* p, const GatherStep step, __global const SurfaceLine* surfaceLines,
                        __global const ShadingLine* shadingLines, __global const LightLine* lightLines,
                        __global const Receiver* receivers, __global const Ray* rays, __global const Hit* hits,
                        __global const GatherPath* paths, __global Ray* shadows, __global GatherArrival* arrivals,
                        __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const PathScene s = scene.surface;
  const Interaction surface = loadInteraction(s, rays[i], hits[i]);
  GatherPath path = gatherPathAt(step, paths, (uint)i);
  const Bsdf b = meetSurface(p, receivers, s, surface, hits[i].t, &path);
  const uint pair = PRELIGHT_PAIR_LIGHTS;
  float3 carried = vload3(0, path.throughput);
  const float followed = isGlossy(b) ? largest(carried) * path.relativeIor2 * roughAlbedo(b, surface.woLocal) : 0.0f;
  if (!survives(fmin(followed, 1.0f), gatherPoint(p, receivers, path.ray, step.depth, pair + 2u).x, &carried)) return;
  LightSample light;
  if (!sampleLight(scene.lights, &p->scene.lights, s, surface.position, gatherBits(p, receivers, path.ray, step.depth, pair),
                   gatherBits(p, receivers, path.ray, step.depth, pair + 1u), &light))
    return;
  float3 radiance = carried * reflectLight(surface, b, path.flags, light);
#ifdef PRELIGHT_DISPERSION
  if ((path.flags & PRELIGHT_GATHER_DISPERSED) == 0u && splitsAsAWhole(b) && takesColor(s, surface, b, 0u))
    radiance *= colorOfWave(gatherPoint(p, receivers, path.ray, 0u, PRELIGHT_PAIR_WAVELENGTH).x);
#endif
#ifdef PRELIGHT_ABSORPTION
  if (path.medium != PRELIGHT_NO_MEDIUM) radiance *= unabsorbed(s, path.medium, light.distance);
#endif
  if (!(largest(radiance) > 0.0f)) return;
  shadows[i] = light.surface ? rayTo(surface, light.direction, light.target, 0.99998f)
                             : rayFrom(surface, light.direction, light.distance);
  vstore3(radiance, 0, arrivals[i].radiance);
  arrivals[i].ray = path.ray;
  marks[i] |= 1u << PRELIGHT_GATHER_SHADOW;
}

// One work-item per shadow ray, in the order of lists from firstListed on; a ray has at most one shadow ray at a time.
// hits [count]. Adds the arrivals of unoccluded shadow rays to radiances.
__kernel void addArrivals(const uint count, const uint firstListed, __global const uint* lists, __global const Hit* hits,
                          __global const GatherArrival* arrivals, __global float* radiances) {
  const size_t i = get_global_id(0);
  if (i >= count || !lightArrives(hits[i])) return;
  const GatherArrival arrival = arrivals[lists[firstListed + i]];
  __global float* out = radiances + 3 * (size_t)arrival.ray;
  vstore3(vload3(0, out) + shadowShare(hits[i]) * vload3(0, arrival.radiance), 0, out);
}
#endif

// One work-item per receiver. radiances [receiver][raysPerReceiver][3] -> irradiance [receiver][3]: pi times their mean, as
// directions are cosine-weighted.
__kernel void sumRadiance(__constant const GatherParameters* p, __global const float* radiances,
                          __global float* irradiance) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  float3 sum = (float3)(0.0f);
  for (uint j = 0; j < p->raysPerReceiver; ++j) sum += vload3(i * p->raysPerReceiver + j, radiances);
  vstore3(sum * (M_PI_F / (float)p->raysPerReceiver), i, irradiance);
}
