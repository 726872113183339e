// Incident light that final gathering has found at receivers, by direction. Before: generateRays, gatherRadiance
// (gather_kernels.cl).
// Options: those of the included file.
#include "project/incident_funcs.cl"
#include "shared/cast_types.h"
#include "shared/gather_types.h"
#include "shared/ray_types.h"

// One work-item per receiver. receivers [receiver]; rays [receiver][raysPerReceiver] as they started, with their radiances
// [..][3] -> incident [receiver][3][value]: irradiance, and incident radiance in SH.
__kernel void sumIncident(__constant const GatherParameters* p, __global const Receiver* receivers,
                          __global const Ray* rays, __global const float* radiances, __global float* incident) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  const float3 normal = vload3(0, receivers[i].normal);
  float3 sums[PRELIGHT_INCIDENT_VALUES];
  for (uint k = 0; k < PRELIGHT_INCIDENT_VALUES; ++k) sums[k] = (float3)(0.0f);
  // On average one cosine-weighted ray lies below this cosine, and the mean of 1 / cosine below it is 2 / cosine.
  const float low = rsqrt((float)p->raysPerReceiver);
  for (uint j = 0; j < p->raysPerReceiver; ++j) {
    const size_t at = i * p->raysPerReceiver + j;
    const float3 direction = vload3(0, rays[at].direction);
    const float cosine = dot(direction, normal);
    addIncident(vload3(at, radiances), direction, cosine < low ? 2.0f / low : 1.0f / cosine, sums);
  }
  storeIncident(sums, M_PI_F / (float)p->raysPerReceiver, incident + 3u * PRELIGHT_INCIDENT_VALUES * i);
}
