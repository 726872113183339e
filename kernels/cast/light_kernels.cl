// Light of the scene's own emitters at receivers, per light group. The light tables hold intensities divided by the
// group's colour, and the emitters of a group lie one behind the other.
// Options: those of transport/light_table_funcs.cl; PRELIGHT_INCIDENT (the light is also kept by direction).
#include "core/sampling_funcs.cl"
#include "core/shadow_share_funcs.cl"
#include "project/incident_funcs.cl"
#include "shared/cast_types.h"
#include "shared/light_group_types.h"
#include "shared/ray_types.h"
#include "transport/scene_funcs.cl"
#include "transport/shadow_ray_funcs.cl"

#ifdef PRELIGHT_INCIDENT
#define PRELIGHT_LIGHT_VALUES PRELIGHT_INCIDENT_VALUES
#else
#define PRELIGHT_LIGHT_VALUES 1u
#endif

// Values per shadow ray: the light that it brings, rgb, and, where light may pass panes, the factor to apply when it
// did.
#ifdef PRELIGHT_SHADOW_SHARES
#define PRELIGHT_RAY_VALUES 4u
#else
#define PRELIGHT_RAY_VALUES 3u
#endif

// Light groups in their buffers (shared/light_group_types.h).
typedef struct LightGroups {
  __global const LightRay* rays;           // [ray]
  __global const uint* emitterOfTriangle;  // [triangle]
  __global const uint* samplesOfGroup;     // [group]
  __global const GroupEmitter* emitters;   // [emitter]
} LightGroups;

LightGroups lightGroupsOf(LightGroupLayout layout, __global const LightGroupLine* lines) {
  const LightGroups groups = {(__global const LightRay*)(lines + layout.rays),
                              (__global const uint*)(lines + layout.emitterOfTriangle),
                              (__global const uint*)(lines + layout.samplesOfGroup),
                              (__global const GroupEmitter*)(lines + layout.emitters)};
  return groups;
}

#ifdef PRELIGHT_EMITTERS
// Returns the density of a direction, 1/sr, summed over a receiver's rays and a group's emitter samples. Dividing
// arriving light by this sum is the balance heuristic (Veach 1997), whichever of the two strategies has drawn the
// direction.
float combinedDensity(uint rays, float cosine, uint samples, float density) {
  return (float)rays * fmax(cosine, 0.0f) * M_1_PI_F + (float)samples * density;
}

// Returns the emitter that a ray has met, or PRELIGHT_NO_EMITTER.
PRELIGHT_INLINE uint emitterMet(LightGroups groups, Lights l, Hit hit) {
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return PRELIGHT_NO_EMITTER;
#ifdef PRELIGHT_EMITTER_PARTS
  return emitterAt(l, hit.triangle, hit.u, hit.v);
#else
  return groups.emitterOfTriangle[hit.triangle];
#endif
}

// Samples a point of the group's emitters; its radiance is divided by the group's colour. Returns false when it sends
// no light to the receiver.
PRELIGHT_INLINE bool sampleGroup(__constant const CastParameters* parameters, LightRay lightRay, LightGroups groups,
                                 Scene scene, Receiver r, LightSample* a) {
  const uint index = r.firstSample / parameters->raysPerReceiver * lightRay.sampleCount + lightRay.sample;
  const uint2 bits = sampleSobolBits(index, hashInteger(r.seed ^ hashInteger(lightRay.group + 0x68bc21ebu)));
  const EmitterPoint e = sampleEmitterPointByPair(scene.lights, lightRay.emitters, scene.surface, bits);
  bool front;
  if (!seeEmitter(scene.lights, e, vload3(0, r.position), a, &front)) return false;
  if (!emitsOn(scene.surface.materials + materialAt(scene.surface.surface, e.triangle), front)) return false;
  a->radiance = vload3(0, groups.emitters[e.emitter].factor);
  a->pdf = combinedDensity(parameters->raysPerReceiver, dot(a->direction, vload3(0, r.normal)), lightRay.sampleCount, a->pdf);
  return true;
}
#endif

// Returns the combined density of a light sample (combinedDensity) divided by the light sampling's own density.
float combinedOverOwn(__constant const CastParameters* parameters, float cosine, LightSample a) {
  return a.punctual ? 1.0f : a.pdf / fmax(a.pdf - (float)parameters->raysPerReceiver * cosine * M_1_PI_F, 1e-6f * a.pdf);
}

// Stores the light that a shadow ray brings, weighted by all strategies that find it, and the factor `alone` that
// undoes the weight: past panes, shadow rays are the only strategy.
void storeRayValue(float3 value, float alone, __global float* values) {
  vstore3(value, 0, values);
#ifdef PRELIGHT_SHADOW_SHARES
  values[3] = alone;
#endif
}

float3 arrivingValue(__global const float* values, Hit shadow) {
  const float3 value = vload3(0, values) * shadowShare(shadow);
#ifdef PRELIGHT_SHADOW_SHARES
  return isPastPanes(shadow) ? value * values[3] : value;
#else
  return value;
#endif
}

// One work-item per shadow ray. receivers [receiver] -> rays [receiver][rayCount] and values [receiver][rayCount], the
// light that each brings if unoccluded. A ray that cannot bring light has value 0 and is made to hit nothing. Next:
// traceShadows.
__kernel void generateLightRays(__constant const CastParameters* parameters, const LightGroupLayout groupLayout,
                                __global const LightGroupLine* groupLines, __constant const SceneLayout* layout,
                                __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                                __global const LightLine* lightLines, __global const Receiver* receivers,
                                __global Ray* rays, __global float* values) {
  const size_t i = get_global_id(0);
  const uint rayCount = groupLayout.rayCount;
  if (i >= (size_t)parameters->receiverCount * rayCount) return;
  __global const Receiver* r = receivers + i / rayCount;
  const LightGroups groups = lightGroupsOf(groupLayout, groupLines);
  const LightRay lightRay = groups.rays[i % rayCount];
  const Scene scene = sceneOf(layout, surfaceLines, shadingLines, lightLines);
  LightSample a;
  bool arrives = false;
#ifdef PRELIGHT_PUNCTUAL
  if (lightRay.light != PRELIGHT_NO_EMITTER) {
    const uint2 place = sampleSobolBits(r->firstSample / max(parameters->raysPerReceiver, 1u), hashInteger(r->seed ^ hashInteger(lightRay.light + 0x5bd1e995u)));
    arrives = samplePunctual(scene.lights, lightRay.light, vload3(0, r->position), (float2)(unitFloat(place.x), unitFloat(place.y)), &a);
  }
#endif
#ifdef PRELIGHT_EMITTERS
  if (lightRay.light == PRELIGHT_NO_EMITTER) arrives = sampleGroup(parameters, lightRay, groups, scene, *r, &a);
#endif
  const float cosine = arrives ? dot(a.direction, vload3(0, r->normal)) : 0.0f;
  // The receiver's own surface hides the directions below it.
  arrives = cosine > 0.0f && dot(a.direction, vload3(0, r->geometricNormal)) > 0.0f;
  rays[i] = shadowRay(r, a, arrives);
  const float3 value = arrives ? a.radiance * (cosine * M_1_PI_F / a.pdf) : (float3)(0.0f);
  storeRayValue(value, arrives ? combinedOverOwn(parameters, cosine, a) : 1.0f, values + PRELIGHT_RAY_VALUES * i);
}

// Adds irradiance `value` that arrives from direction `way` to a group of a receiver's out [3][group][value].
void addLight(__global float* out, uint group, uint groupCount, float3 value, float3 way, float3 normal) {
#ifdef PRELIGHT_INCIDENT
  float shares[PRELIGHT_LIGHT_VALUES];
  const float3 direction = normalize(way);
  incidentValues(direction, inverseCosine(direction, normal), shares);
#else
  const float shares[1] = {1.0f};
#endif
  const float channels[3] = {value.x, value.y, value.z};
  for (uint c = 0; c < 3; ++c)
    for (uint i = 0; i < PRELIGHT_LIGHT_VALUES; ++i)
      out[(c * groupCount + group) * PRELIGHT_LIGHT_VALUES + i] += shares[i] * channels[c];
}

// One work-item per receiver. shadowRays, shadowHits, values [receiver][rayCount] of generateLightRays -> out
// [receiver][3][groupCount], irradiance divided by pi and by the group's colour; with PRELIGHT_INCIDENT
// [receiver][3][groupCount][value], see project/incident_funcs.cl. Next: addEmitterHits, where there are emitters.
__kernel void sumLightRays(__constant const CastParameters* parameters, const LightGroupLayout groupLayout,
                           __global const LightGroupLine* groupLines, __global const Receiver* receivers,
                           __global const Ray* shadowRays, __global const Hit* shadowHits, __global const float* values,
                           __global float* out) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const LightGroups groups = lightGroupsOf(groupLayout, groupLines);
  const uint rayCount = groupLayout.rayCount, groupCount = groupLayout.groupCount;
  const uint length = 3 * groupCount * PRELIGHT_LIGHT_VALUES;
  out += receiver * length;
  for (uint i = 0; i < length; ++i) out[i] = 0.0f;
  const float3 normal = vload3(0, receivers[receiver].normal);
  for (uint s = 0; s < rayCount; ++s) {
    const size_t at = receiver * rayCount + s;
    if (!lightArrives(shadowHits[at])) continue;
    const float3 value = arrivingValue(values + PRELIGHT_RAY_VALUES * at, shadowHits[at]);
    addLight(out, groups.rays[s].group, groupCount, value, vload3(0, shadowRays[at].direction), normal);
  }
}

#ifdef PRELIGHT_EMITTERS
// One work-item per receiver. rays, hits [receiver][raysPerReceiver] of the hemisphere, the closest ones: adds the
// light of the emitters that they meet to out [receiver] of sumLightRays.
__kernel void addEmitterHits(__constant const CastParameters* parameters, const LightGroupLayout groupLayout,
                             __global const LightGroupLine* groupLines, __constant const SceneLayout* layout,
                             __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                             __global const LightLine* lightLines, __global const Receiver* receivers,
                             __global const Ray* rays, __global const Hit* hits, __global float* out) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const LightGroups groups = lightGroupsOf(groupLayout, groupLines);
  const Scene scene = sceneOf(layout, surfaceLines, shadingLines, lightLines);
  out += receiver * 3 * groupLayout.groupCount * PRELIGHT_LIGHT_VALUES;
  const float3 normal = vload3(0, receivers[receiver].normal);
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    const size_t at = receiver * parameters->raysPerReceiver + j;
    const Hit hit = hits[at];
    const uint emitter = emitterMet(groups, scene.lights, hit);
    if (emitter == PRELIGHT_NO_EMITTER) continue;
    const float3 direction = vload3(0, rays[at].direction);
    const DeviceTriangle t = triangleAt(scene.surface.surface, hit.triangle);
    const float leaving = -dot(direction, frontNormal(vertexPosition(scene.surface, t.vertex[0]),
                                                      vertexPosition(scene.surface, t.vertex[1]),
                                                      vertexPosition(scene.surface, t.vertex[2])));
    const float cosine = dot(direction, normal);
    if (cosine <= 0.0f || !emitsOn(scene.surface.materials + t.material, leaving > 0.0f)) continue;
    const GroupEmitter e = groups.emitters[emitter];
    const float density =
        pdfEmitter(emitterDensity(scene.lights, hit.triangle, hit.u, hit.v), parameters->nearLimit + hit.t, leaving);
    const float share = cosine * M_1_PI_F /
                        combinedDensity(parameters->raysPerReceiver, cosine, groups.samplesOfGroup[e.group], density);
    addLight(out, e.group, groupLayout.groupCount, share * vload3(0, e.factor), direction, normal);
  }
}
#endif
