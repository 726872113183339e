// Projectors: a receiver's hits are summed up to ambient occlusion, bent normal and SH transfer.
// Option: PRELIGHT_SH_ORDER, 0 when no SH is requested.
#include "core/lanes_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

#ifndef PRELIGHT_SH_ORDER
#define PRELIGHT_SH_ORDER 0
#endif

#if PRELIGHT_SH_ORDER > 0
#include "project/sh_funcs.cl"
#endif

// Returns the visibility of eight rays: 1 open, 0 blocked.
float8 openLanes(__constant const CastParameters* parameters, __global const Hit* hits) {
  float open[8];
  for (int k = 0; k < 8; ++k) open[k] = visibilityOf(parameters, hits[k]);
  return vload8(0, open);
}

// One work-item per receiver. rays, hits [receiver][raysPerReceiver] -> values [receiver][valueCount]:
//   [0] k, the open fraction: cosine-weighted accessibility
//   [1..3] and [4..] the mean over rays of (V - k) (direction, Y_i)
// The host then adds k times the closed form of the unoccluded hemisphere. That is a control variate with coefficient
// k: an open receiver becomes exact, and so does a closed one. The mean is biased by the covariance of k and the mean
// of Y over the block, which is negligible because the block integrates the smooth Y almost exactly.
__kernel void projectHits(__constant const CastParameters* parameters, __constant const float* shTable,
                          __global const Ray* rays, __global const Hit* hits, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint count = parameters->raysPerReceiver;
  rays += receiver * count;
  hits += receiver * count;
  values += receiver * parameters->valueCount;

  float open = 0.0f;
  for (uint j = 0; j < count; ++j) open += visibilityOf(parameters, hits[j]);
  const float scale = 1.0f / (float)count;
  const float k = open * scale;

  float8 sumX = 0.0f, sumY = 0.0f, sumZ = 0.0f;
#if PRELIGHT_SH_ORDER > 0
  float8 sum[PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER];
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) sum[i] = 0.0f;
#endif
  // An entirely open or closed receiver has all weights 0.
  const bool mixed = open > 0.0f && open < (float)count;
  for (uint j = 0; mixed && j < count; j += 8) {
    float x[8], y[8], z[8];
    for (int i = 0; i < 8; ++i) {
      x[i] = rays[j + i].direction[0];
      y[i] = rays[j + i].direction[1];
      z[i] = rays[j + i].direction[2];
    }
    const float8 dx = vload8(0, x), dy = vload8(0, y), dz = vload8(0, z);
    const float8 weight = openLanes(parameters, hits + j) - k;
    sumX += weight * dx;
    sumY += weight * dy;
    sumZ += weight * dz;
#if PRELIGHT_SH_ORDER > 0
    accumulateSh(shTable, dx, dy, dz, weight, sum);
#endif
  }
  values[0] = k;
  values[1] = sumOf(sumX) * scale;
  values[2] = sumOf(sumY) * scale;
  values[3] = sumOf(sumZ) * scale;
#if PRELIGHT_SH_ORDER > 0
  for (int i = 0; i < PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER; ++i) values[4 + i] = sumOf(sum[i]) * scale;
#endif
}
