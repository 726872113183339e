// Final gathering whose sums keep light apart that single rays bring far above the mean of their receiver: of a small bright
// place that few receivers happen to meet, and those too strongly.
//   cast/generate_kernels.cl -> [trace, and gather_kernels.cl] -> sumBounded
#include "core/inline.h"
#include "core/largest_funcs.cl"
#include "shared/gather_types.h"

// Rounds in which the mean of bounded rays is found. A single ray among 256 shrinks below its bound in two.
#define ROUNDS 4

// One work-item per receiver. radiances [receiver][raysPerReceiver][3] -> sums [receiver][bounded, excess][3], irradiance: pi
// times the mean of what rays bring up to a bound, and of what they bring beyond. The bound is a multiple of the mean of
// bounded rays.
__kernel void sumBounded(__constant const GatherParameters* p, const float mostOfMean, __global const float* radiances,
                         __global float* sums) {
  const size_t i = get_global_id(0);
  if (i >= p->receiverCount) return;
  __global const float* own = radiances + 3 * i * p->raysPerReceiver;
  const float share = 1.0f / (float)p->raysPerReceiver;
  float bound = MAXFLOAT;
  for (uint round = 0u; round < ROUNDS; ++round) {
    float mean = 0.0f;
    for (uint j = 0u; j < p->raysPerReceiver; ++j) mean += share * fmin(largest(vload3(j, own)), bound);
    bound = mostOfMean * mean;
  }
  float3 bounded = (float3)(0.0f), excess = (float3)(0.0f);
  for (uint j = 0u; j < p->raysPerReceiver; ++j) {
    const float3 radiance = vload3(j, own);
    const float most = largest(radiance);
    const float3 kept = most > bound ? radiance * (bound / most) : radiance;
    bounded += kept;
    excess += radiance - kept;
  }
  vstore3(bounded * (M_PI_F * share), 2 * i, sums);
  vstore3(excess * (M_PI_F * share), 2 * i + 1, sums);
}
