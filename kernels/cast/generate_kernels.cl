// Receivers to rays.
#include "core/sampling_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// A ray a work-item. receivers [receiver] -> rays [receiver][raysPerReceiver], cosine-weighted around the shading
// normal. Rays that dip below the triangle itself may hit it: the surface hides that part of the hemisphere.
// Next: traceClosestHits or traceAnyHits.
__kernel void generateRays(__constant const CastParameters* parameters, __global const Receiver* receivers,
                           __global Ray* rays) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  const uint receiver = (uint)(i / parameters->raysPerReceiver);
  const uint sample = (uint)(i % parameters->raysPerReceiver);
  __global const Receiver* r = receivers + receiver;
  const float2 u = sampleSobol(r->firstSample + sample, r->seed);
  const float3 direction = sampleCosineHemisphere(u, vload3(0, r->normal));
  Ray ray;
  vstore3(vload3(0, r->position), 0, ray.origin);
  vstore3(direction, 0, ray.direction);
  ray.sourceTriangle = dot(direction, vload3(0, r->geometricNormal)) > 0.0f ? r->triangle : PRELIGHT_NO_TRIANGLE;
  ray.tMax = MAXFLOAT;
  rays[i] = ray;
}
