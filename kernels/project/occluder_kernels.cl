// Aggregation of vector occluders (Sherif 2013, 7.2) from a block's hits.
// Options: those of the surface (bvh/alpha_funcs.cl); PRELIGHT_OCCLUDER_MIRRORS, PRELIGHT_OCCLUDER_WAYS_THROUGH: with what
// is mirrored and what comes through glass (project/occluder_way_kernels.cl).
#include "bvh/alpha_funcs.cl"
#include "cast/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/occluder_types.h"
#include "shared/ray_types.h"

#define PRELIGHT_MAX_RAYS 256

// The occluder of a hit is that of the corner that is nearest by its weight: triangles may join two.
uint occluderOf(DeviceTriangle t, Hit hit, __global const uint* groups) {
  const float w = 1.0f - hit.u - hit.v;
  return groups[t.vertex[hit.u > w ? (hit.v > hit.u ? 2u : 1u) : (hit.v > w ? 2u : 0u)]];
}

void addVector(__global float* sum, float3 v) {
  sum[0] += v.x;
  sum[1] += v.y;
  sum[2] += v.z;
}

// Normal and accessibility (w) of the side that is seen, which damps its normal (7.2.4); 0 where that is a back.
float4 facingOf(Surface surface, DeviceTriangle t, Hit hit, float3 direction, __global const float* geometricNormals,
                __global const uint* flags, __global const OccluderVertex* vertices) {
  const bool back = dot(direction, vload3(hit.triangle, geometricNormals)) > 0.0f;
  if (back && (flags[t.material] & PRELIGHT_OCCLUDER_TWO_SIDED) == 0u) return (float4)(0.0f);
  __global const float* a = vertices[t.vertex[0]].normal;
  __global const float* b = vertices[t.vertex[1]].normal;
  __global const float* c = vertices[t.vertex[2]].normal;
  const float4 at = (1.0f - hit.u - hit.v) * vload4(0, a) + hit.u * vload4(0, b) + hit.v * vload4(0, c);
  const float3 normal = at.xyz * rsqrt(fmax(dot(at.xyz, at.xyz), 1e-12f));
  return (float4)(back ? -normal : normal, at.w);
}

#if defined(PRELIGHT_OCCLUDER_MIRRORS) || defined(PRELIGHT_OCCLUDER_WAYS_THROUGH)
void addWay(__global OccluderWaySums* sums, OccluderWay way, float share) {
  addVector(sums->vector, share * way.share * vload3(0, way.vector));
  addVector(sums->color, share * way.share * vload3(0, way.color));
  sums->formFactor += share * way.share;
}
#endif

// A receiver a work-item. receivers; rays, hits [receiver][raysPerReceiver]; flags [material]; vertices, groups [vertex];
// mirrored, through [receiver][raysPerReceiver], mirrorHits by their slots -> records, as many a receiver as it sees
// occluders: spans [receiver] first and number of its own, in the order in which its rays meet them; mirrorSums and
// throughSums beside the records. `counter` is 0 before and the number of all records after.
// Rays are cosine-weighted, so that each is worth 1 / raysPerReceiver of form factor (Eq. 7.1).
__kernel void aggregateOccluders(__constant const CastParameters* parameters, __global const Ray* rays,
                                 __global const Hit* hits, __global const DeviceTriangle* triangles,
                                 __global const DeviceMaterial* materials, __global const float2* texCoords,
                                 __global const float4* colors, __global const ushort4* texels,
                                 __global const float* geometricNormals, __global const uint* flags,
                                 __global const OccluderVertex* vertices, __global const uint* groups,
                                 __global uint* counter, __global uint2* spans, __global OccluderSums* records
#ifdef PRELIGHT_OCCLUDER_MIRRORS
                                 , __global const OccluderWay* mirrored, __global const Hit* mirrorHits,
                                 __global OccluderWaySums* mirrorSums
#endif
#ifdef PRELIGHT_OCCLUDER_WAYS_THROUGH
                                 , __global const OccluderWay* through, __global OccluderWaySums* throughSums
#endif
) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const Surface surface = {triangles, materials, texCoords, colors, texels};
  const uint rayCount = parameters->raysPerReceiver;
  const size_t firstRay = receiver * rayCount;
  rays += firstRay;
  hits += firstRay;
  uint seen[PRELIGHT_MAX_RAYS];
  uchar recordOf[PRELIGHT_MAX_RAYS];
  uint count = 0;
  for (uint j = 0; j < rayCount; ++j) {
    if (hits[j].triangle == PRELIGHT_NO_TRIANGLE) continue;
    const uint group = occluderOf(triangles[hits[j].triangle], hits[j], groups);
    uint k = 0;
    while (k < count && seen[k] != group) ++k;
    if (k == count) seen[count++] = group;
    recordOf[j] = (uchar)k;
  }
  const uint first = atomic_add(counter, count);
  spans[receiver] = (uint2)(first, count);
  records += first;
  for (uint k = 0; k < count; ++k) {
    const OccluderSums none = {0.0f, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f,
                               {0.0f, 0.0f, 0.0f}, seen[k]};
    records[k] = none;
#ifdef PRELIGHT_OCCLUDER_MIRRORS
    mirrorSums[first + k] = (OccluderWaySums){{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f};
#endif
#ifdef PRELIGHT_OCCLUDER_WAYS_THROUGH
    throughSums[first + k] = (OccluderWaySums){{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f};
#endif
  }
  for (uint j = 0; j < rayCount; ++j) {
    const Hit hit = hits[j];
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) continue;
    __global OccluderSums* sums = records + recordOf[j];
    const DeviceTriangle t = triangles[hit.triangle];
    const float3 direction = vload3(0, rays[j].direction);
    const float share = (1.0f - visibilityOf(parameters, hit)) / (float)rayCount;
    const float distance = parameters->nearLimit + hit.t;
    const float4 facing = facingOf(surface, t, hit, direction, geometricNormals, flags, vertices);
    sums->formFactor += share;
    addVector(sums->direction, share * direction);
    addVector(sums->offset, share * distance * direction);
    sums->distance += share * distance;
    addVector(sums->normal, share * facing.w * facing.xyz);
    sums->accessibility += share * facing.w;
    addVector(sums->color, share * clamp(surfaceColor(surface, hit.triangle, hit.u, hit.v).xyz, 0.0f, 1.0f));
#ifdef PRELIGHT_OCCLUDER_MIRRORS
    const OccluderWay mirror = mirrored[firstRay + j];
    if (mirror.share > 0.0f && mirrorHits[mirror.slot].triangle == PRELIGHT_NO_TRIANGLE)
      addWay(mirrorSums + first + recordOf[j], mirror, share);
#endif
#ifdef PRELIGHT_OCCLUDER_WAYS_THROUGH
    if (through[firstRay + j].share > 0.0f) addWay(throughSums + first + recordOf[j], through[firstRay + j], share);
#endif
  }
}
