// Final gathering: a receiver's cosine-weighted rays look up what diffuse surfaces send. Mirrors, glass and glossy lobes
// are followed to such surfaces. Lamps and the sky count only behind a lobe that is not narrow: seen straight they are
// direct light, through narrow lobes alone caustics.
// Options: those of the included files, PRELIGHT_ABSORPTION, PRELIGHT_FOLLOWS (some surface reflects otherwise than
// diffusely).
#include "core/sampling_funcs.cl"
#include "gather/irradiance_map_funcs.cl"
#include "project/incident_funcs.cl"
#include "shade/diffuse_funcs.cl"
#include "shade/glass_funcs.cl"
#include "shade/lobe_class_funcs.cl"
#include "shade/scene_funcs.cl"
#include "shared/cast_types.h"
#include "shared/gather_types.h"

#define PRELIGHT_GATHER_PAIRS 3u  // of random numbers at a surface: lobe and roulette, direction

// Of the receiver's own sequence, whatever it is gathered together with.
float2 gatherPoint(__constant const GatherParameters* p, __global const Receiver* receivers, uint ray, uint depth, uint pair) {
  const uint receiver = ray / p->raysPerReceiver;
  const uint sample = receivers[receiver].firstSample + ray % p->raysPerReceiver;
  const uint dimension = hashInteger(p->seed + (depth * PRELIGHT_GATHER_PAIRS + pair) * 0x9e3779b9u);
  const uint2 bits = samplePaddedBits(sample, hashInteger(receivers[receiver].seed ^ dimension));
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

// Light that a ray finds where it ends, without what its surface reflects diffusely.
float3 findLamp(__constant const GatherParameters* p, PathScene s, Lights l, Ray ray, Hit hit) {
#ifdef PRELIGHT_SKY
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return skyRadiance(l, &p->scene.lights, skyCoordinates(&p->scene.lights, vload3(0, ray.direction)));
#endif
#ifdef PRELIGHT_EMITTERS
  if (hit.triangle != PRELIGHT_NO_TRIANGLE && l.emitterDensities[hit.triangle] > 0.0f)
    return emittedRadiance(s, hit.triangle, hit.u, hit.v, loadVertex(s, ray, hit).front);
#endif
  return (float3)(0.0f);
}

#ifdef PRELIGHT_FOLLOWS
// Where a ray goes on from a surface by one of its lobes that are not diffuse. False: nowhere.
bool follow(__constant const GatherParameters* p, __global const Receiver* receivers, PathScene s, PathVertex v, Bsdf b,
            uint depth, GatherPath* path, float3* direction) {
  const Frame frame = frameAround(v.shading);
  const float3 wo = toFrame(frame, v.wo);
  const LobeChoice lobes = chooseLobes(b, wo.z, false, true);
  if (!(lobes.specular + lobes.glass > 0.0f)) return false;
  const float2 chance = gatherPoint(p, receivers, path->ray, depth, 0u);
  float3 weight;
  float relativeIor2 = 1.0f;
#ifdef PRELIGHT_GLASS
  if (chance.x >= lobes.specular) {
    const float rest = clamp((chance.x - lobes.specular) / lobes.glass, 0.0f, 0.99999994f);
    *direction = leaveGlass(s, v, b, wo.z, rest, &weight, &relativeIor2, &path->medium);
    weight *= b.glass / lobes.glass;
  } else
#endif
  {
    float3 wi = (float3)(-wo.x, -wo.y, wo.z);
    if (b.smooth) {
      weight = (b.metal + b.layer * schlick(b, wo.z)) / lobes.specular;
    } else {
      wi = sampleLobe(b, true, gatherPoint(p, receivers, path->ray, depth, 1u), wo);
      if (wi.z <= 0.0f) return false;
      const LobeChoice one = {0.0f, 1.0f, 0.0f};
      weight = evaluateBsdf(b, wo, wi).glossy / (scatterDensity(b, one, wo, wi) * lobes.specular);
    }
    *direction = fromFrame(frame, wi);
    if (dot(*direction, v.geometric) <= 0.0f) return false;
    if (!isNarrow(b)) path->widened = 1u;
  }
  const float3 throughput = vload3(0, path->throughput) * weight / relativeIor2;
  path->relativeIor2 *= relativeIor2;
  float survival = fmin(largest(throughput) * path->relativeIor2, 1.0f);
  if (depth >= p->longWay) survival *= 0.5f;
  if (!(survival > 0.0f) || chance.y >= survival) return false;
  vstore3(throughput / survival, 0, path->throughput);
  return true;
}
#endif

// A ray a work-item, its first surface if depth is 0: paths are then not read. receivers [receiver of the block]; rays
// and paths lie where the step says, hits [count]; radiances [ray of the block][3] are set at depth 0 and added to beyond ->
// rays and paths of those that go on [counter].
__kernel void gatherRadiance(__constant const GatherParameters* p, const GatherStep step,
                             __global const SurfaceLine* surface, __global const ShadingLine* shading,
                             __global const LightLine* lights, __global const IrradianceLine* irradiances,
                             __global const Receiver* receivers, __global Ray* rays, __global const Hit* hits,
                             __global GatherPath* paths, __global float* radiances, __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const Scene scene = sceneOf(&p->scene, surface, shading, lights);
  const PathScene s = scene.surface;
  const IrradianceMap map = irradianceMapOf(&p->map, irradiances);
  GatherPath path = {{1.0f, 1.0f, 1.0f}, 1.0f, PRELIGHT_NO_MEDIUM, (uint)i, 0u};
  if (step.depth > 0u) path = paths[step.first + i];
  const Ray ray = rays[step.first + i];
  const Hit hit = hits[i];
  float3 radiance = (float3)(0.0f);
  if (path.widened != 0u) radiance = findLamp(p, s, scene.lights, ray, hit);
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) {
    const PathVertex vertex = loadVertex(s, ray, hit);
    const Bsdf bsdf = loadBsdf(s, vertex);
#ifdef PRELIGHT_ABSORPTION
    uint medium = path.medium;
    if (!vertex.front && (s.materials[vertex.material].flags & PRELIGHT_SOLID) != 0u) medium = vertex.material;
    if (medium != PRELIGHT_NO_MEDIUM)
      vstore3(vload3(0, path.throughput) * exp(-vload3(0, s.materials[medium].absorption) * hit.t), 0, path.throughput);
#endif
    if (largest(bsdf.diffuse) > 0.0f)
      radiance += reflectIrradiance(bsdf, dot(vertex.wo, vertex.shading),
                                    irradianceAt(map, hit.triangle, vertex.front, hit.u, hit.v));
#ifdef PRELIGHT_TRANSLUCENT
    if (largest(bsdf.transmitted) > 0.0f)
      radiance += transmitIrradiance(bsdf, dot(vertex.wo, vertex.shading),
                                     irradianceAt(map, hit.triangle, !vertex.front, hit.u, hit.v));
#endif
    radiance *= vload3(0, path.throughput);
#ifdef PRELIGHT_FOLLOWS
    float3 direction;
    if (follow(p, receivers, s, vertex, bsdf, step.depth, &path, &direction)) {
      const uint slot = atomic_inc(counter);
      rays[step.next + slot] = rayFrom(vertex, normalize(direction), MAXFLOAT);
      paths[step.next + slot] = path;
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

// A receiver a work-item. receivers [receiver]; rays [receiver][raysPerReceiver] as they started, with their radiances
// [..][3] -> incident [receiver][3][5]: irradiance, and incident radiance in SH of order 2.
__kernel void sumIncident(__constant const GatherParameters* p, __global const Receiver* receivers,
                          __global const Ray* rays, __global const float* radiances, __global float* incident) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  const float3 normal = vload3(0, receivers[i].normal);
  float3 sums[PRELIGHT_INCIDENT_VALUES];
  for (uint k = 0; k < PRELIGHT_INCIDENT_VALUES; ++k) sums[k] = (float3)(0.0f);
  // Of cosine-weighted rays one is below this cosine on average, where 1 / cosine has the mean 2 / cosine.
  const float low = rsqrt((float)p->raysPerReceiver);
  for (uint j = 0; j < p->raysPerReceiver; ++j) {
    const size_t at = i * p->raysPerReceiver + j;
    const float3 direction = vload3(0, rays[at].direction);
    const float cosine = dot(direction, normal);
    addIncident(vload3(at, radiances), direction, cosine < low ? 2.0f / low : 1.0f / cosine, sums);
  }
  storeIncident(sums, M_PI_F / (float)p->raysPerReceiver, incident + 3u * PRELIGHT_INCIDENT_VALUES * i);
}
