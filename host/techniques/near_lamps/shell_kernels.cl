// Hits by distance. A shell is a range of distances from the receiver: its hits block the light of lamps that are
// farther away.
// Option: PRELIGHT_SH_ORDER, at least 1.
#include "core/inline.h"
#include "core/lanes_funcs.cl"
#include "project/sh_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Returns the share of the light from behind that a hit blocks if its distance is in [from, before), m; otherwise 0.
PRELIGHT_INLINE float blockedWithin(__constant const CastParameters* parameters, Hit hit, float from, float before) {
  const float distance = parameters->nearLimit + hit.t;
  const bool within = hit.triangle != PRELIGHT_NO_TRIANGLE && distance >= from && distance < before;
  return within ? 1.0f - visibilityOf(parameters, hit) : 0.0f;
}

// One work-item per receiver and shell. starts [shell - 1], m; rays, hits [receiver][raysPerReceiver] -> values
// [receiver][shell][1 + order^2]:
//   [0] k, the blocked fraction, cosine-weighted
//   [1..] the mean over rays of (B - k) Y_i
// The host adds k times the closed form of the unoccluded hemisphere, the control variate of projectHits, so that the
// shells and the open part sum to that closed form.
__kernel void projectShells(__constant const CastParameters* parameters, uint shells, __global const float* starts,
                            __constant const float* shTable, __global const Ray* rays, __global const Hit* hits,
                            __global float* values) {
  const size_t item = get_global_id(0);
  if (item >= (size_t)parameters->receiverCount * shells) return;
  const size_t receiver = item / shells;
  const uint shell = (uint)(item % shells);
  const uint count = parameters->raysPerReceiver;
  rays += receiver * count;
  hits += receiver * count;
  values += item * (1 + PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER);
  const float from = shell > 0 ? starts[shell - 1] : -1.0f;
  const float before = shell + 1 < shells ? starts[shell] : INFINITY;

  float blocked = 0.0f;
  for (uint j = 0; j < count; ++j) blocked += blockedWithin(parameters, hits[j], from, before);
  const float scale = 1.0f / (float)count;
  const float k = blocked * scale;
  float8 sum[PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER];
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) sum[i] = 0.0f;
  const bool mixed = blocked > 0.0f && blocked < (float)count;
  for (uint j = 0; mixed && j < count; j += 8) {
    float weights[8];
    for (int i = 0; i < 8; ++i) weights[i] = blockedWithin(parameters, hits[j + i], from, before) - k;
    accumulateRays(shTable, rays + j, weights, sum);
  }
  values[0] = k;
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) values[1 + i] = sumOf(sum[i]) * scale;
}
