// Direct light at points of elements, by direction. Before: aimAtLights (direct_kernels.cl), traceShadows.
// Options: those of the included files.
#include "core/shadow_share_funcs.cl"
#include "project/incident_funcs.cl"
#include "radiosity/direct_rays_funcs.cl"
#include "shared/cast_types.h"
#include "shared/radiosity_types.h"
#include "shared/ray_types.h"

// One work-item per point. rays, hits, values [point][ray] of aimAtLights -> incident [point][3][value] of punctual
// lights and the sky: irradiance, and incident radiance in SH.
__kernel void sumIncident(const DirectRays counts, __global const Receiver* receivers, __global const Ray* rays,
                          __global const Hit* hits, __global const float* values, __global float* incident) {
  const size_t point = get_global_id(0);
  if (point >= counts.points) return;
  const uint rayCount = raysOf(counts);
  const float3 normal = vload3(0, receivers[point].normal);
  float3 sums[PRELIGHT_INCIDENT_VALUES];
  for (uint i = 0; i < PRELIGHT_INCIDENT_VALUES; ++i) sums[i] = (float3)(0.0f);
  for (uint s = 0; s < rayCount; ++s) {
    const size_t at = point * rayCount + s;
    if (s >= counts.punctual && s < counts.punctual + counts.emitterSamples) continue;
    if (!lightArrives(hits[at])) continue;
    const float3 direction = normalize(vload3(0, rays[at].direction));
    addIncident(shadowShare(hits[at]) * vload3(at, values), direction, inverseCosine(direction, normal), sums);
  }
  storeIncident(sums, 1.0f, incident + 3u * PRELIGHT_INCIDENT_VALUES * point);
}
