// Final gathering: a receiver's cosine-weighted rays look up what diffuse surfaces send. Mirrors, glass and glossy lobes
// are followed to such surfaces. Lamps and the sky count only behind a lobe that is not narrow: seen straight they are
// direct light, through narrow lobes alone caustics.
// Options: those of the included files, PRELIGHT_ABSORPTION, PRELIGHT_FOLLOWS (some surface reflects otherwise than
// diffusely).
#include "core/sampling_funcs.cl"
#include "gather/irradiance_map_funcs.cl"
#include "shared/cast_types.h"
#include "shared/gather_types.h"
#include "transport/dispersion_funcs.cl"
#include "transport/irradiance_funcs.cl"
#include "transport/medium_funcs.cl"
#include "transport/roulette_funcs.cl"
#include "transport/scene_funcs.cl"

#define PRELIGHT_GATHER_PAIRS 3u  // of random numbers at a surface: lobe and roulette, direction

// A point of the receiver's own sequence, whatever it is gathered together with.
float2 gatherPoint(__constant const GatherParameters* p, __global const Receiver* receivers, uint ray, uint depth, uint pair) {
  const uint receiver = ray / p->raysPerReceiver;
  const uint sample = receivers[receiver].firstSample + ray % p->raysPerReceiver;
  const uint dimension = hashInteger(p->seed + (depth * PRELIGHT_GATHER_PAIRS + pair) * 0x9e3779b9u);
  const uint2 bits = samplePaddedBits(sample, hashInteger(receivers[receiver].seed ^ dimension));
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

#ifdef PRELIGHT_FOLLOWS
// Where a ray goes on from a surface by one of its lobes that are not diffuse. False: nowhere.
PRELIGHT_INLINE bool follow(__constant const GatherParameters* p, __global const Receiver* receivers, PathScene s,
                            Interaction surface, Bsdf b, uint depth, GatherPath* path, Ray* next) {
  const float2 chance = gatherPoint(p, receivers, path->ray, depth, 0u), u = gatherPoint(p, receivers, path->ray, depth, 1u);
  const uint lobes = PRELIGHT_LOBES_ALL & ~PRELIGHT_LOBES_DIFFUSE;
#ifdef PRELIGHT_DISPERSION
  const float wave = gatherPoint(p, receivers, path->ray, 0u, PRELIGHT_PAIR_WAVELENGTH).x;
  disperse(s, surface, wave, path->dispersed != 0u, &b);
#endif
  BsdfSample sample;
  if (!sampleBsdf(surface, b, lobes, PRELIGHT_RADIANCE, chance.x, u, &sample)) return false;
  if ((sample.lobe & narrowLobes(b)) == 0u) path->widened = 1u;
  float3 throughput = carriedBy(sample, vload3(0, path->throughput));
#ifdef PRELIGHT_DISPERSION
  if (path->dispersed == 0u && takesColor(s, surface, b, sample.lobe)) {
    throughput *= colorOfWave(wave);
    path->dispersed = 1u;
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

// A ray a work-item, its first surface if depth is 0: paths are then not read. receivers [receiver of the block]; rays,
// paths and hits [count]; radiances [ray of the block][3] are set at depth 0 and added to beyond -> rays and paths of those that
// go on, from step.next on in the same places, and marks.
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
  GatherPath path = {{1.0f, 1.0f, 1.0f}, 1.0f, PRELIGHT_NO_MEDIUM, (uint)i, 0u, 0u};
  if (step.depth > 0u) path = paths[i];
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  float3 radiance = (float3)(0.0f);
  marks[i] = 0;
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(s, ray, hit);
  const bool front = hit.triangle != PRELIGHT_NO_TRIANGLE && surface.front;  // nothing may be read of a surface that is none
  if (path.widened != 0u) radiance = evalLight(scene.lights, &p->scene.lights, s, ray, hit, front);
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) {
    const Bsdf bsdf = loadBsdf(s, surface);
#ifdef PRELIGHT_ABSORPTION
    const uint medium = mediumBefore(surface, path.medium);
    if (medium != PRELIGHT_NO_MEDIUM)
      vstore3(vload3(0, path.throughput) * transmittance(s, medium, hit.t), 0, path.throughput);
#endif
    if (largest(bsdf.diffuse) > 0.0f)
      radiance += reflectIrradiance(bsdf, surface.woLocal, irradianceAt(map, hit.triangle, surface.front, hit.u, hit.v));
#ifdef PRELIGHT_TRANSLUCENT
    if (largest(bsdf.transmitted) > 0.0f)
      radiance += transmitIrradiance(bsdf, surface.woLocal, irradianceAt(map, hit.triangle, !surface.front, hit.u, hit.v));
#endif
    radiance *= vload3(0, path.throughput);
#ifdef PRELIGHT_FOLLOWS
    Ray next;
    if (follow(p, receivers, s, surface, bsdf, step.depth, &path, &next)) {
      rays[step.next + i] = next;
      paths[step.next + i] = path;
      marks[i] = 1;
    }
#endif
  } else {
    radiance *= vload3(0, path.throughput);
  }
  __global float* out = radiances + 3 * (size_t)path.ray;
  vstore3(step.depth == 0u ? radiance : vload3(0, out) + radiance, 0, out);
}

// A receiver a work-item. radiances [receiver][raysPerReceiver][3] -> irradiance [receiver][3]: pi times their mean, as
// directions are cosine-weighted.
__kernel void sumRadiance(__constant const GatherParameters* p, __global const float* radiances,
                          __global float* irradiance) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  float3 sum = (float3)(0.0f);
  for (uint j = 0; j < p->raysPerReceiver; ++j) sum += vload3(i * p->raysPerReceiver + j, radiances);
  vstore3(sum * (M_PI_F / (float)p->raysPerReceiver), i, irradiance);
}
