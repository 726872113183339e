// Aggregation of vector occluders (Sherif 2013, 7.2) from stored transport.
#include "shared/cast_types.h"
#include "shared/occluder_types.h"
#include "shared/ray_types.h"

#define PRELIGHT_MAX_RAYS 256

uint occluderOf(__constant const CastParameters* parameters, __global const OccluderVertex* vertices, uint slot) {
  return vertices[slot < parameters->vertexCount ? slot : slot - parameters->vertexCount].group;
}

void addVector(__global float* sum, float3 v) {
  sum[0] += v.x;
  sum[1] += v.y;
  sum[2] += v.z;
}

// A hit's share of its occluder: rays are cosine-weighted, so that each is worth 1 / raysPerReceiver of form factor
// (Eq. 7.1). The sender's vertex stands for the point that was hit: the barycentric weights chose it, and the mean of its
// place, normal and accessibility is that of what they interpolate to.
void addHit(__constant const CastParameters* parameters, float3 origin, float3 direction, Sender sender,
            __global const OccluderVertex* vertices, float share, __global OccluderSums* sums) {
  const bool back = sender.slot >= parameters->vertexCount;
  __global const OccluderVertex* vertex = vertices + (back ? sender.slot - parameters->vertexCount : sender.slot);
  const float3 offset = vload3(0, vertex->position) - origin;
  const float3 albedo = (float3)((float)(sender.albedo & 1023u), (float)(sender.albedo >> 10 & 1023u),
                                 (float)(sender.albedo >> 20 & 1023u));
  sums->formFactor += share;
  addVector(sums->direction, share * direction);
  addVector(sums->offset, share * offset);
  sums->distance += share * length(offset);
  addVector(sums->color, share * (1.0f / 1023.0f) * albedo);
  if (back) return;
  addVector(sums->normal, share * vertex->accessibility * vload3(0, vertex->normal));
  sums->accessibility += share * vertex->accessibility;
}

// A receiver a work-item. receivers, rays, senders [receiver][raysPerReceiver] of the rows from firstStored on; vertices
// [vertex] -> records, as many a receiver as it sees occluders: spans [receiver] first and number of its own, in the order
// in which its rays meet them. `counter` is 0 before and the number of all records after.
__kernel void aggregateOccluders(__constant const CastParameters* parameters, __global const Receiver* receivers,
                                 __global const Ray* rays, __global const Sender* senders,
                                 __global const OccluderVertex* vertices, __global uint* counter,
                                 __global uint2* spans, __global OccluderSums* records) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint rayCount = parameters->raysPerReceiver;
  rays += receiver * rayCount;
  senders += ((size_t)parameters->firstStored + receiver) * rayCount;
  uint groups[PRELIGHT_MAX_RAYS];
  uint count = 0;
  for (uint j = 0; j < rayCount; ++j) {
    if (senders[j].slot == PRELIGHT_NO_TRIANGLE) continue;
    const uint group = occluderOf(parameters, vertices, senders[j].slot);
    uint k = 0;
    while (k < count && groups[k] != group) ++k;
    if (k == count) groups[count++] = group;
  }
  const uint first = atomic_add(counter, count);
  spans[receiver] = (uint2)(first, count);
  records += first;
  for (uint k = 0; k < count; ++k) {
    const OccluderSums none = {0.0f, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f,
                               {0.0f, 0.0f, 0.0f}, groups[k]};
    records[k] = none;
  }
  const float3 origin = vload3(0, receivers[receiver].position);
  const float share = 1.0f / (float)rayCount;
  for (uint j = 0; j < rayCount; ++j) {
    const Sender sender = senders[j];
    if (sender.slot == PRELIGHT_NO_TRIANGLE) continue;
    const uint group = occluderOf(parameters, vertices, sender.slot);
    uint k = 0;
    while (groups[k] != group) ++k;
    addHit(parameters, origin, vload3(0, rays[j].direction), sender, vertices, share, records + k);
  }
}
