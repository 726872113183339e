// Hits by azimuth: openness of sectors around the normals of receivers.
#include "core/inline.h"
#include "core/surface_frame_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Returns the sector, of `sectors` around a frame's normal, in which a direction lies.
PRELIGHT_INLINE uint sectorOf(float3 tangent, float3 bitangent, float3 direction, uint sectors) {
  const float turn = atan2(dot(direction, bitangent), dot(direction, tangent)) * 0.159154943f;
  const float around = turn < 0.0f ? turn + 1.0f : turn;
  return min((uint)(around * (float)sectors), sectors - 1);
}

// One work-item per receiver. rays, hits [receiver][raysPerReceiver] -> values [receiver][3][sector]: the number of
// each sector's rays that are blocked, the number that escape, and the sum over blocked rays of the squared sine of
// their height above the tangent plane, all divided by the mean number of rays per sector. Quotients of sums over many
// receivers are exact where a sector is all open or all closed, however many rays fell into it.
__kernel void projectSectors(__constant const CastParameters* parameters, uint sectors, __global const Receiver* receivers,
                             __global const Ray* rays, __global const Hit* hits, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver;
  rays += receiver * count;
  hits += receiver * count;
  values += receiver * 3 * sectors;

  float open = 0.0f;
  for (uint j = 0; j < count; ++j) open += visibilityOf(parameters, hits[j]);
  const float k = open / (float)count;
  const bool alike = open <= 0.0f || open >= (float)count;
  for (uint s = 0; s < sectors; ++s) {
    values[s] = alike ? 1.0f - k : 0.0f;
    values[sectors + s] = alike ? k : 0.0f;
    values[2 * sectors + s] = alike ? 0.5f * (1.0f - k) : 0.0f;
  }
  if (alike) return;
  const float3 normal = vload3(0, receivers[receiver].normal);
  const float3 tangent = surfaceTangent(normal);
  const float3 bitangent = cross(normal, tangent);
  const float scale = (float)sectors / (float)count;
  for (uint j = 0; j < count; ++j) {
    const float3 direction = vload3(0, rays[j].direction);
    const uint s = sectorOf(tangent, bitangent, direction, sectors);
    const float v = visibilityOf(parameters, hits[j]), height = dot(direction, normal);
    values[s] += scale * (1.0f - v);
    values[sectors + s] += scale * v;
    values[2 * sectors + s] += scale * (1.0f - v) * height * height;
  }
}
