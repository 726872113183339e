// Hits of one tree beside those of another.
#include "shared/ray_types.h"

// A ray a work-item: hits [rayCount] become those of `others` [rayCount] where these are nearer.
__kernel void keepNearer(const uint rayCount, __global const Hit* others, __global Hit* hits) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Hit hit = hits[i], other = others[i];
  if (other.triangle == PRELIGHT_NO_TRIANGLE) return;
  if (hit.triangle == PRELIGHT_NO_TRIANGLE || other.t < hit.t || (other.t == hit.t && other.triangle < hit.triangle))
    hits[i] = other;
}
