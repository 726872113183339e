// Light of the scene's own emitters at receivers, group by group.
// Options: PRELIGHT_EMITTERS: some light is an emissive triangle; PRELIGHT_INCIDENT: the light is kept by direction, too.
#include "bvh/alpha_funcs.cl"
#include "core/sampling_funcs.cl"
#include "project/incident_funcs.cl"
#include "shared/cast_types.h"
#include "shared/light_group_types.h"
#include "shared/ray_types.h"
#include "transport/aim_funcs.cl"

#ifdef PRELIGHT_INCIDENT
#define PRELIGHT_LIGHT_VALUES PRELIGHT_INCIDENT_VALUES
#else
#define PRELIGHT_LIGHT_VALUES 1u
#endif

typedef struct LightGroups {
  __global const LightRay* rays;  // [ray]
  __global const PunctualLight* punctual;
  __global const float* factors;           // [light][3]
  __global const uint* emitterOfTriangle;  // [triangle]
  __global const uint* samplesOfGroup;     // [group]
  __global const float* positions;         // [vertex][3]
  __global const float* normals;           // [triangle][3]
} LightGroups;

LightGroups lightGroupsOf(LightGroupLayout layout, __global const LightGroupLine* lines) {
  const LightGroups groups = {(__global const LightRay*)(lines + layout.rays),
                              (__global const PunctualLight*)(lines + layout.punctual),
                              (__global const float*)(lines + layout.factors),
                              (__global const uint*)(lines + layout.emitterOfTriangle),
                              (__global const uint*)(lines + layout.samplesOfGroup),
                              (__global const float*)(lines + layout.positions),
                              (__global const float*)(lines + layout.normals)};
  return groups;
}

// Density of a direction, 1/sr, among a receiver's rays and a group's emitter samples together: the balance heuristic
// (Veach 1997) then divides what arrives by this sum, whichever of the two has drawn it.
float combinedDensity(uint rays, float cosine, uint samples, float density, float squaredDistance, float emitterCosine) {
  return (float)rays * cosine * M_1_PI_F + (float)samples * density * squaredDistance / fmax(emitterCosine, 1e-9f);
}

bool aimAtEmitter(__constant const CastParameters* parameters, LightRay lightRay, LightGroups groups,
                  __global const GroupEmitter* emitters, Surface surface, float2 u, float3 point,
                  float3 normal, Aim* aim) {
  uint low = lightRay.firstEmitter, high = low + lightRay.emitterCount - 1u;
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if (u.x < emitters[middle].bound)
      high = middle;
    else
      low = middle + 1u;
  }
  const GroupEmitter e = emitters[low];
  const float start = low > lightRay.firstEmitter ? emitters[low - 1u].bound : 0.0f;
  const float within = clamp((u.x - start) / fmax(e.bound - start, 1e-30f), 0.0f, 1.0f);
  const DeviceTriangle t = triangleAt(surface, e.triangle);
  const float3 p = vload3(t.vertex[0], groups.positions), q = vload3(t.vertex[1], groups.positions),
               r = vload3(t.vertex[2], groups.positions);
  const float3 way = pointBetween(p, q, r, sampleTriangle((float2)(within, u.y))) - point;
  const float squared = dot(way, way);
  const float3 direction = way * rsqrt(fmax(squared, 1e-30f));
  const float cosine = dot(direction, normal);
  const float facing = -dot(direction, vload3(e.triangle, groups.normals));
  const float emitterCosine = e.twoSided ? fabs(facing) : facing;
  if (!(squared > 1e-18f) || cosine <= 0.0f || emitterCosine <= 1e-6f) return false;
  aim->way = way;
  aim->reach = PRELIGHT_SHADOW_REACH;
  aim->value = cosine * M_1_PI_F * vload3(0, e.factor) /
                  combinedDensity(parameters->raysPerReceiver, cosine, lightRay.sampleCount, e.density, squared, emitterCosine);
  return true;
}

// A shadow ray a work-item. receivers [receiver] -> rays [receiver][rayCount], and values [receiver][rayCount][3], what
// each brings if it is open: 0 for a ray that cannot bring anything, which is made to hit nothing. Next: traceRays.
__kernel void generateLightRays(__constant const CastParameters* parameters, const LightGroupLayout groupLayout,
                                __global const LightGroupLine* groupLines, __global const GroupEmitter* emitters,
                                __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                                __global const Receiver* receivers, __global Ray* rays, __global float* values) {
  const size_t i = get_global_id(0);
  const uint rayCount = groupLayout.rayCount;
  if (i >= (size_t)parameters->receiverCount * rayCount) return;
  __global const Receiver* r = receivers + i / rayCount;
  const LightGroups groups = lightGroupsOf(groupLayout, groupLines);
  const LightRay lightRay = groups.rays[i % rayCount];
  const float3 point = vload3(0, r->position), normal = vload3(0, r->normal);
  Aim aim;
  bool arrives;
  if (lightRay.light != PRELIGHT_NO_EMITTER) {
    float share;
    arrives = aimAtPunctual(groups.punctual + lightRay.light, point, normal, &aim, &share);
    if (arrives) aim.value = share * M_1_PI_F * vload3(0, groups.factors + 3 * lightRay.light);
  } else {
    const uint index = r->firstSample / parameters->raysPerReceiver * lightRay.sampleCount + lightRay.sample;
    const float2 u = sampleSobol(index, hashInteger(r->seed ^ hashInteger(lightRay.group + 0x68bc21ebu)));
    arrives = aimAtEmitter(parameters, lightRay, groups, emitters, surfaceOf(layout, surfaceLines), u, point, normal, &aim);
  }
  arrives = arrives && dot(aim.way, vload3(0, r->geometricNormal)) > 0.0f;  // the receiver's own surface hides the rest
  rays[i] = shadowRay(r, aim, arrives);
  vstore3(arrives ? aim.value : (float3)(0.0f), i, values);
}

// Adds light that brings `value`, of irradiance, along a ray to a group of a receiver's out [3][group][value].
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

// A receiver a work-item. shadowRays, shadowHits [receiver][rayCount] of the kernel above with their values; rays, hits
// [receiver][raysPerReceiver] of the hemisphere, the closest ones -> out [receiver][3][groupCount], irradiance over pi and the group's colour; [..][value]
// with PRELIGHT_INCIDENT, see project/incident_funcs.cl.
__kernel void projectLights(__constant const CastParameters* parameters, const LightGroupLayout groupLayout,
                            __global const LightGroupLine* groupLines, __global const GroupEmitter* emitters,
                            __global const Receiver* receivers, __global const Ray* shadowRays,
                            __global const Hit* shadowHits, __global const float* values, __global const Ray* rays,
                            __global const Hit* hits, __global float* out) {
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
    if (shadowHits[at].triangle != PRELIGHT_NO_TRIANGLE) continue;
    addLight(out, groups.rays[s].group, groupCount, vload3(at, values), vload3(0, shadowRays[at].direction), normal);
  }
#ifdef PRELIGHT_EMITTERS
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    const size_t at = receiver * parameters->raysPerReceiver + j;
    const Hit hit = hits[at];
    if (hit.triangle == PRELIGHT_NO_TRIANGLE || groups.emitterOfTriangle[hit.triangle] == PRELIGHT_NO_EMITTER) continue;
    const GroupEmitter e = emitters[groups.emitterOfTriangle[hit.triangle]];
    const float3 direction = vload3(0, rays[at].direction);
    const float facing = -dot(direction, vload3(hit.triangle, groups.normals));
    const float emitterCosine = e.twoSided ? fabs(facing) : facing;
    const float cosine = dot(direction, normal);
    if (emitterCosine <= 1e-6f || cosine <= 0.0f) continue;
    const float distance = parameters->nearLimit + hit.t;
    const float share = cosine * M_1_PI_F / combinedDensity(parameters->raysPerReceiver, cosine, groups.samplesOfGroup[e.group],
                                                            e.density, distance * distance, emitterCosine);
    addLight(out, e.group, groupCount, share * vload3(0, e.factor), direction, normal);
  }
#endif
}
