// Hits by distance. A shell is a range of distances from the receiver: its hits block the light of lamps that are
// farther away.
// Options: PRELIGHT_SH_ORDER, at least 1; PRELIGHT_RAYS, raysPerReceiver, 8 to 256; PRELIGHT_SHELLS, 1 to 254.
#include "core/inline.h"
#include "core/lanes_funcs.cl"
#include "project/sh_funcs.cl"
#include "project/visibility_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

#define FUNCTIONS (PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER)
#define BINS (PRELIGHT_SHELLS + 1)  // one for each shell, then one for the rays that escape
#define PLACES (PRELIGHT_RAYS + 8 * BINS)

// Rays of a receiver, sorted by bins. Each bin begins at a multiple of eight.
typedef struct SortedRays {
  uint begin[BINS];
  uint count[BINS];
  float x[PLACES], y[PLACES], z[PLACES];  // direction
  float blocked[PLACES];                  // share of the light from behind that the ray's hit blocks
} SortedRays;

// Returns the bin of a hit.
PRELIGHT_INLINE uint binOf(__constant const CastParameters* parameters, __global const float* starts, Hit hit) {
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return PRELIGHT_SHELLS;
  const float distance = parameters->nearLimit + hit.t;
  uint shell = 0;
  for (uint k = 0; k + 1 < PRELIGHT_SHELLS; ++k) shell += distance >= starts[k] ? 1 : 0;
  return shell;
}

// Reads rays and hits in their order, because memory is read ahead that way.
void sortRays(__constant const CastParameters* parameters, __global const float* starts, __global const Ray* rays,
              __global const Hit* hits, SortedRays* sorted) {
  uchar bins[PRELIGHT_RAYS];
  for (uint bin = 0; bin < BINS; ++bin) sorted->count[bin] = 0;
  for (uint j = 0; j < PRELIGHT_RAYS; ++j) {
    bins[j] = (uchar)binOf(parameters, starts, hits[j]);
    ++sorted->count[bins[j]];
  }
  uint next[BINS];
  for (uint bin = 0, begin = 0; bin < BINS; ++bin) {
    sorted->begin[bin] = next[bin] = begin;
    begin += (sorted->count[bin] + 7) & ~7u;
  }
  for (uint j = 0; j < PRELIGHT_RAYS; ++j) {
    const uint place = next[bins[j]]++;
    sorted->x[place] = rays[j].direction[0];
    sorted->y[place] = rays[j].direction[1];
    sorted->z[place] = rays[j].direction[2];
    sorted->blocked[place] = 1.0f - visibilityOf(parameters, hits[j]);
  }
}

// Adds weight x Y_i of a bin's rays to sum[i] and returns the sum of weights. The weight is what a hit blocks, or with
// `open` what it lets through.
float addBin(__constant const float* shTable, const SortedRays* sorted, uint bin, bool open, float8* sum) {
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  float8 total = 0.0f;
  for (uint j = 0; j < sorted->count[bin]; j += 8) {
    const uint at = sorted->begin[bin] + j;
    const float8 blocked = vload8(0, sorted->blocked + at);
    const int8 present = lane + (int)j < (int)sorted->count[bin];
    const float8 zero = 0.0f;
    const float8 x = select(zero, vload8(0, sorted->x + at), present);
    const float8 y = select(zero, vload8(0, sorted->y + at), present);
    const float8 z = select(zero, vload8(0, sorted->z + at), present);
    const float8 weight = select(zero, open ? 1.0f - blocked : blocked, present);
    total += weight;
    accumulateSh(shTable, x, y, z, weight, sum);
  }
  return sumOf(total);
}

// Writes the mean over rays of B Y_i to values [shell][i] where shells have hits, the mean of B to k [shell], and the
// mean of Y_i to mean [i], where B is what a ray's hit blocks in the shell.
void meansOf(__constant const CastParameters* parameters, __constant const float* shTable, const SortedRays* sorted,
             __global float* values, float* k, float* mean) {
  const float scale = 1.0f / (float)PRELIGHT_RAYS;
  float8 sum[FUNCTIONS], rest[FUNCTIONS];
  for (int i = 0; i < FUNCTIONS; ++i) rest[i] = mean[i] = 0.0f;
  for (uint shell = 0; shell < PRELIGHT_SHELLS; ++shell) {
    k[shell] = 0.0f;
    if (sorted->count[shell] == 0) continue;
    for (int i = 0; i < FUNCTIONS; ++i) sum[i] = 0.0f;
    k[shell] = scale * addBin(shTable, sorted, shell, false, sum);
    if (parameters->obscurance > 0.0f) addBin(shTable, sorted, shell, true, rest);
    for (int i = 0; i < FUNCTIONS; ++i) {
      const float value = scale * sumOf(sum[i]);
      mean[i] += value;
      values[shell * FUNCTIONS + i] = value;
    }
  }
  addBin(shTable, sorted, PRELIGHT_SHELLS, true, rest);
  for (int i = 0; i < FUNCTIONS; ++i) mean[i] += scale * sumOf(rest[i]);
}

// One work-item per receiver. starts [shell - 1], m; zonal [band], the transfer of an unoccluded receiver over Y of its
// normal; rays, hits [receiver][raysPerReceiver] -> values [receiver][shell][order^2]:
//   the mean over rays of (B - k) Y_i, plus k times the closed form of the unoccluded hemisphere,
// where B is what the ray's hit blocks in the shell, and k its mean. The closed form is the control variate of
// projectHits, so that the shells and the open part sum to it. Only a shell's own rays have a B, so that each ray is
// evaluated once for all shells.
__kernel void projectShells(__constant const CastParameters* parameters, __global const float* starts,
                            __constant const float* zonal, __constant const float* shTable,
                            __global const Receiver* receivers, __global const Ray* rays, __global const Hit* hits,
                            __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  values += receiver * PRELIGHT_SHELLS * FUNCTIONS;
  SortedRays sorted;
  sortRays(parameters, starts, rays + receiver * PRELIGHT_RAYS, hits + receiver * PRELIGHT_RAYS, &sorted);
  float k[PRELIGHT_SHELLS], mean[FUNCTIONS], open[FUNCTIONS];
  meansOf(parameters, shTable, &sorted, values, k, mean);
  evaluateSh(shTable, vload3(0, receivers[receiver].normal), open);
  for (int l = 0; l < PRELIGHT_SH_ORDER; ++l)
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) open[i] *= zonal[l];
  for (uint shell = 0; shell < PRELIGHT_SHELLS; ++shell)
    for (int i = 0; i < FUNCTIONS; ++i) {
      __global float* value = values + shell * FUNCTIONS + i;
      *value = k[shell] > 0.0f ? *value + k[shell] * (open[i] - mean[i]) : 0.0f;
    }
}
