// Hits by azimuth: how open sectors around the normals of receivers are.
#include "core/inline.h"
#include "core/surface_frame_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Which of `sectors` around a frame's normal a direction lies in.
PRELIGHT_INLINE uint sectorOf(float3 tangent, float3 bitangent, float3 direction, uint sectors) {
  const float turn = atan2(dot(direction, bitangent), dot(direction, tangent)) * 0.159154943f;
  const float around = turn < 0.0f ? turn + 1.0f : turn;
  return min((uint)(around * (float)sectors), sectors - 1);
}

// A receiver a work-item. rays, hits [receiver][raysPerReceiver] -> values [receiver][sector], the open fraction of the
// cosine-weighted sky that a sector has: k of the whole hemisphere plus the mean of V - k over the rays of the sector, as if
// there were as many of them everywhere. So an open receiver is exact, and the mean of the sectors is k. With k of the other
// rays the mean of many receivers would be exact, were rays independent: that is the factor beside the sectors.
__kernel void projectSectors(__constant const CastParameters* parameters, uint sectors, __global const Receiver* receivers,
                             __global const Ray* rays, __global const Hit* hits, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver;
  rays += receiver * count;
  hits += receiver * count;
  values += receiver * sectors;

  float open = 0.0f;
  for (uint j = 0; j < count; ++j) open += visibilityOf(parameters, hits[j]);
  const float k = open / (float)count;
  for (uint s = 0; s < sectors; ++s) values[s] = k;
  if (open <= 0.0f || open >= (float)count) return;
  const float3 normal = vload3(0, receivers[receiver].normal);
  const float3 tangent = surfaceTangent(normal);
  const float3 bitangent = cross(normal, tangent);
  const float scale = (float)sectors / (float)(count - 1);
  for (uint j = 0; j < count; ++j) {
    const float3 direction = vload3(0, rays[j].direction);
    values[sectorOf(tangent, bitangent, direction, sectors)] += scale * (visibilityOf(parameters, hits[j]) - k);
  }
}
