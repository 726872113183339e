// Rays through bodies: how far inward rays of receivers run until they leave the surface again.
// Tested by tests/techniques/thickness_test.cpp.
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// One work-item per ray. receivers [receiver], rays [receiver][raysPerReceiver] -> inward, as rays: each ray mirrored at
// the tangent plane of its receiver's shading normal, so that rays are cosine-weighted around the inward normal. They
// start on the inner side of the surface: receivers are lifted off it by 2^-19 of the largest coordinate. A ray that
// would leave through its own triangle meets nothing. Next: the closest hits of `inward`, then measureThickness.
__kernel void turnInward(__constant const CastParameters* parameters, __global const Receiver* receivers,
                         __global const Ray* rays, __global Ray* inward) {
  const size_t i = get_global_id(0);
  const uint count = parameters->raysPerReceiver;
  if (i >= (size_t)parameters->receiverCount * count) return;
  __global const Receiver* r = receivers + i / count;
  const float3 position = vload3(0, r->position), normal = vload3(0, r->normal);
  const float3 geometric = vload3(0, r->geometricNormal), outward = vload3(0, rays[i].direction);
  const float3 direction = outward - 2.0f * dot(outward, normal) * normal;
  const float3 size = fabs(position);
  const float lift = 0x1p-18f * fmax(size.x, fmax(size.y, size.z));
  Ray ray;
  vstore3(position - 2.0f * lift * geometric, 0, ray.origin);
  ray.sourceTriangle = r->triangle;
  vstore3(direction, 0, ray.direction);
  ray.tMax = dot(direction, geometric) < 0.0f ? MAXFLOAT : -1.0f;
  inward[i] = ray;
}

// One work-item per receiver. inward, hits [receiver][raysPerReceiver]; geometricNormals [triangle][3] -> thickness
// [receiver]: the mean length of the rays, m. A ray that does not leave through the back of a surface runs through no
// body, and its length is 0: sheets have no thickness.
__kernel void measureThickness(__constant const CastParameters* parameters, __global const Ray* inward,
                               __global const Hit* hits, __global const float* geometricNormals,
                               __global float* thickness) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver;
  float sum = 0.0f;
  for (uint j = 0; j < count; ++j) {
    const Hit hit = hits[receiver * count + j];
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) continue;
    const float3 direction = vload3(0, inward[receiver * count + j].direction);
    if (dot(direction, vload3(hit.triangle, geometricNormals)) > 0.0f) sum += hit.t;
  }
  thickness[receiver] = sum / (float)count;
}
