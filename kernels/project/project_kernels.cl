// Projectors: the hits of a receiver become ambient occlusion, bent normal and SH transfer.
// Option: PRELIGHT_SH_ORDER, 0 when no SH is asked for.
#include "shared/cast_types.h"
#include "shared/ray_types.h"

#ifndef PRELIGHT_SH_ORDER
#define PRELIGHT_SH_ORDER 0
#endif

#if PRELIGHT_SH_ORDER > 0
#include "project/sh_funcs.cl"
#endif

float sum8(float8 v) {
  const float4 a = v.lo + v.hi;
  const float2 b = a.lo + a.hi;
  return b.x + b.y;
}

// Visibility of eight rays: 1 open, 0 blocked.
float8 openLanes(__global const Hit* hits) {
  float open[8];
  for (int k = 0; k < 8; ++k) open[k] = hits[k].triangle == PRELIGHT_NO_TRIANGLE ? 1.0f : 0.0f;
  return vload8(0, open);
}

// A receiver a work-item. rays, hits [receiver][raysPerReceiver] -> values [receiver][valueCount]:
//   [0] k, the open fraction: cosine-weighted accessibility
//   [1..3] and [4..] the mean over rays of (V - k') (direction, Y_i)
// To these the host adds k times the closed form of the unoccluded hemisphere. That is a control variate with
// coefficient k', the open fraction of the *other* half of the receiver's rays, which leaves the mean unbiased:
// an open receiver becomes exact, and so does a closed one.
__kernel void projectHits(__constant const CastParameters* parameters, __constant const float* shTable,
                          __global const Ray* rays, __global const Hit* hits, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver;
  const uint half_ = count / 2;
  rays += receiver * count;
  hits += receiver * count;
  values += receiver * parameters->valueCount;

  float openFirst = 0.0f, openSecond = 0.0f;
  for (uint j = 0; j < half_; ++j) openFirst += hits[j].triangle == PRELIGHT_NO_TRIANGLE ? 1.0f : 0.0f;
  for (uint j = half_; j < count; ++j) openSecond += hits[j].triangle == PRELIGHT_NO_TRIANGLE ? 1.0f : 0.0f;
  const float kFirst = openFirst / (float)half_;
  const float kSecond = openSecond / (float)half_;

  float8 sumX = 0.0f, sumY = 0.0f, sumZ = 0.0f;
#if PRELIGHT_SH_ORDER > 0
  float8 sum[PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER];
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) sum[i] = 0.0f;
#endif
  const uint8 lane = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  // An entirely open or closed receiver has all weights 0.
  const bool mixed = openFirst + openSecond > 0.0f && openFirst + openSecond < (float)count;
  for (uint j = 0; mixed && j < count; j += 8) {
    float x[8], y[8], z[8];
    for (int k = 0; k < 8; ++k) {
      x[k] = rays[j + k].direction[0];
      y[k] = rays[j + k].direction[1];
      z[k] = rays[j + k].direction[2];
    }
    const float8 dx = vload8(0, x), dy = vload8(0, y), dz = vload8(0, z);
    const float8 other = select((float8)(kFirst), (float8)(kSecond), lane + j < (uint8)(half_));
    const float8 weight = openLanes(hits + j) - other;
    sumX += weight * dx;
    sumY += weight * dy;
    sumZ += weight * dz;
#if PRELIGHT_SH_ORDER > 0
    accumulateSh(shTable, dx, dy, dz, weight, sum);
#endif
  }
  const float scale = 1.0f / (float)count;
  values[0] = 0.5f * (kFirst + kSecond);
  values[1] = sum8(sumX) * scale;
  values[2] = sum8(sumY) * scale;
  values[3] = sum8(sumZ) * scale;
#if PRELIGHT_SH_ORDER > 0
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) values[4 + i] = sum8(sum[i]) * scale;
#endif
}
