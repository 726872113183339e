// Final gathering whose rays prefer the directions from which photons have come (Jensen 1995). The directions follow a
// histogram over the square from which the cosine-weighted hemisphere is drawn. Some of the rays are spread evenly, so
// that no direction is left out, and each ray is weighted by the inverse of the combined density (the balance
// heuristic).
//   generateGuidedRays -> [trace, and gather_kernels.cl] -> sumGuided
#include "cast/receiver_rays_funcs.cl"
#include "core/inline.h"
#include "shared/gather_types.h"

// The image of a point of [0,1) when eight cells get their shares of the interval: the cell, and the position within
// it.
typedef struct WarpedPoint {
  uint cell;
  float at;
} WarpedPoint;

PRELIGHT_INLINE WarpedPoint warp(float u, const float* weights) {
  float sum = 0.0f;
  for (uint k = 0u; k < PRELIGHT_GUIDE_SIDE; ++k) sum += weights[k];
  float left = u * sum;
  uint cell = 0u;
  while (cell + 1u < PRELIGHT_GUIDE_SIDE && left >= weights[cell]) left -= weights[cell++];
  const float within = clamp(left / weights[cell], 0.0f, 0.99999f);
  const WarpedPoint point = {cell, fmin(((float)cell + within) / (float)PRELIGHT_GUIDE_SIDE, 0.99999994f)};
  return point;
}

// One work-item per eight rays, drawn as generateRays draws them. guides [receiver][row][column] densities over the
// square, of mean 1 and above 0 -> rays, weights [receiver][raysPerReceiver].
__kernel void generateGuidedRays(__constant const GatherParameters* p, __global const Receiver* receivers,
                                 __global const float* guides, __global Ray* rays, __global float* weights) {
  const size_t i = get_global_id(0);
  const uint count = p->raysPerReceiver;
  if (i >= (size_t)p->receiverCount * (count / 8)) return;
  __global const Receiver* r = receivers + i / (count / 8);
  __global const float* guide = guides + (i / (count / 8)) * PRELIGHT_GUIDE_CELLS;
  const uint8 cell = (uint)(i % (count / 8)) * 8 + (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  float8 u8, v8;
  sampleSobol8(sobolIndexInCell8(cell, 31 - clz(count), r->firstSample, r->seed), r->seed, &u8, &v8);
  float u[8], v[8], rows[PRELIGHT_GUIDE_SIDE];
  vstore8(u8, 0, u);
  vstore8(v8, 0, v);
  for (uint k = 0u; k < PRELIGHT_GUIDE_SIDE; ++k) {
    rows[k] = 0.0f;
    for (uint c = 0u; c < PRELIGHT_GUIDE_SIDE; ++c) rows[k] += guide[k * PRELIGHT_GUIDE_SIDE + c];
  }
  for (uint k = 0u; k < 8u; ++k) {
    const WarpedPoint row = warp(u[k], rows);
    float columns[PRELIGHT_GUIDE_SIDE];
    for (uint c = 0u; c < PRELIGHT_GUIDE_SIDE; ++c) columns[c] = guide[row.cell * PRELIGHT_GUIDE_SIDE + c];
    const WarpedPoint column = warp(v[k], columns);
    u[k] = row.at;
    v[k] = column.at;
    weights[i * 8 + k] = 1.0f / columns[column.cell];
  }
  storeReceiverRays(r, vload8(0, u), vload8(0, v), 0.0f, MAXFLOAT, rays + i * 8);
}

// One work-item per receiver: as sumRadiance, with one weight per ray.
__kernel void sumGuided(__constant const GatherParameters* p, __global const float* radiances, __global const float* weights,
                        __global float* irradiance) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  float3 sum = (float3)(0.0f);
  for (uint j = 0; j < p->raysPerReceiver; ++j) {
    const size_t at = i * p->raysPerReceiver + j;
    sum += weights[at] * vload3(at, radiances);
  }
  vstore3(sum * (M_PI_F / (float)p->raysPerReceiver), i, irradiance);
}
