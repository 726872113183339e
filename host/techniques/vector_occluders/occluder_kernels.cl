// Aggregation of vector occluders (Sherif 2013, 7.2) from a block's hits.
// Options: those of the surface (transport/alpha_funcs.cl); PRELIGHT_OCCLUDER_MIRRORS, PRELIGHT_OCCLUDER_WAYS_THROUGH:
// also sum up mirrored light and light through glass (techniques/vector_occluders/occluder_way_kernels.cl).
#include "transport/alpha_funcs.cl"
#include "techniques/vector_occluders/occluder_scene_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/occluder_types.h"
#include "shared/ray_types.h"

#define PRELIGHT_MAX_RAYS 256

// Returns the occluder of a hit: that of the corner with the greatest weight, because a triangle may join two
// occluders.
uint occluderOf(DeviceTriangle t, Hit hit, __global const uint* groups) {
  const float w = 1.0f - hit.u - hit.v;
  return groups[t.vertex[hit.u > w ? (hit.v > hit.u ? 2u : 1u) : (hit.v > w ? 2u : 0u)]];
}

void addVector(__global float* sum, float3 v) {
  sum[0] += v.x;
  sum[1] += v.y;
  sum[2] += v.z;
}

// Returns the normal of the visible side, and in w the accessibility that damps it (7.2.4); 0 when the visible side is
// a back.
float4 facingOf(OccluderScene occluders, DeviceTriangle t, Hit hit, float3 direction,
                __global const float* geometricNormals) {
  const bool back = dot(direction, vload3(hit.triangle, geometricNormals)) > 0.0f;
  if (back && (occluders.flags[t.material] & PRELIGHT_OCCLUDER_TWO_SIDED) == 0u) return (float4)(0.0f);
  __global const float* a = occluders.vertices[t.vertex[0]].normal;
  __global const float* b = occluders.vertices[t.vertex[1]].normal;
  __global const float* c = occluders.vertices[t.vertex[2]].normal;
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

// Distinguishes the occluders of a receiver's rays, in the order in which the rays meet them: seen [record], recordOf
// [ray]. Returns their number.
uint listOccluders(Surface surface, OccluderScene occluders, uint rayCount, __global const Hit* hits, uint* seen,
                   uchar* recordOf) {
  uint count = 0;
  for (uint j = 0; j < rayCount; ++j) {
    if (hits[j].triangle == PRELIGHT_NO_TRIANGLE) continue;
    const uint group = occluderOf(triangleAt(surface, hits[j].triangle), hits[j], occluders.groups);
    uint k = 0;
    while (k < count && seen[k] != group) ++k;
    if (k == count) seen[count++] = group;
    recordOf[j] = (uchar)k;
  }
  return count;
}

void clearRecord(uint group, __global OccluderSums* record, __global OccluderWaySums* waySums) {
  const OccluderSums none = {0.0f, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f,
                             {0.0f, 0.0f, 0.0f}, group};
  *record = none;
#ifdef PRELIGHT_OCCLUDER_MIRRORS
  waySums[PRELIGHT_WAY_MIRRORED] = (OccluderWaySums){{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f};
#endif
#ifdef PRELIGHT_OCCLUDER_WAYS_THROUGH
  waySums[PRELIGHT_WAY_THROUGH] = (OccluderWaySums){{0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, 0.0f};
#endif
}

// Adds a ray's ways to a record's sums. `share`: the form factor of a ray.
void addWays(__global const OccluderWay* ways, __global const Hit* mirrorHits, float share,
             __global OccluderWaySums* waySums) {
#ifdef PRELIGHT_OCCLUDER_MIRRORS
  const OccluderWay mirror = ways[PRELIGHT_WAY_MIRRORED];
  if (mirror.share > 0.0f && mirrorHits[mirror.ray].triangle == PRELIGHT_NO_TRIANGLE)
    addWay(waySums + PRELIGHT_WAY_MIRRORED, mirror, share);
#endif
#ifdef PRELIGHT_OCCLUDER_WAYS_THROUGH
  if (ways[PRELIGHT_WAY_THROUGH].share > 0.0f) addWay(waySums + PRELIGHT_WAY_THROUGH, ways[PRELIGHT_WAY_THROUGH], share);
#endif
}

// One work-item per receiver. rays, hits [receiver][raysPerReceiver]; ways [receiver][raysPerReceiver][PRELIGHT_WAYS],
// mirrorHits [mirror ray] -> records, one per occluder that a receiver sees; spans [1 + receiver], first record and
// number of records; waySums [record][PRELIGHT_WAYS]. spans[0].x must be 0 and holds the number of all records
// afterwards. Rays are cosine-weighted, so that each contributes a form factor of 1 / raysPerReceiver (Eq. 7.1).
__kernel void aggregateOccluders(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                                 __global const SurfaceLine* surfaceLines, __global const OccluderLine* occluderLines,
                                 __global const float* geometricNormals, __global const Ray* rays,
                                 __global const Hit* hits, __global const OccluderWay* ways,
                                 __global const Hit* mirrorHits, __global uint2* spans, __global OccluderSums* records,
                                 __global OccluderWaySums* waySums) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const Surface surface = surfaceOf(layout, surfaceLines);
  const OccluderScene occluders = occludersOf(layout, occluderLines);
  const uint rayCount = parameters->raysPerReceiver;
  const size_t firstRay = receiver * rayCount;
  rays += firstRay;
  hits += firstRay;
  uint seen[PRELIGHT_MAX_RAYS];
  uchar recordOf[PRELIGHT_MAX_RAYS];
  const uint count = listOccluders(surface, occluders, rayCount, hits, seen, recordOf);
  const uint first = atomic_add((__global uint*)spans, count);
  spans[1 + receiver] = (uint2)(first, count);
  records += first;
  waySums += PRELIGHT_WAYS * (size_t)first;
  for (uint k = 0; k < count; ++k) clearRecord(seen[k], records + k, waySums + PRELIGHT_WAYS * k);
  for (uint j = 0; j < rayCount; ++j) {
    const Hit hit = hits[j];
    if (hit.triangle == PRELIGHT_NO_TRIANGLE) continue;
    __global OccluderSums* sums = records + recordOf[j];
    const float3 direction = vload3(0, rays[j].direction);
    const float share = (1.0f - visibilityOf(parameters, hit)) / (float)rayCount;
    const float distance = parameters->nearLimit + hit.t;
    const float4 facing = facingOf(occluders, triangleAt(surface, hit.triangle), hit, direction, geometricNormals);
    sums->formFactor += share;
    addVector(sums->direction, share * direction);
    addVector(sums->offset, share * distance * direction);
    sums->distance += share * distance;
    addVector(sums->normal, share * facing.w * facing.xyz);
    sums->accessibility += share * facing.w;
    addVector(sums->color, share * clamp(surfaceColor(surface, hit.triangle, hit.u, hit.v).xyz, 0.0f, 1.0f));
    addWays(ways + PRELIGHT_WAYS * (firstRay + j), mirrorHits, share, waySums + PRELIGHT_WAYS * recordOf[j]);
  }
}
