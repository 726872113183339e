// Merging of the hits of two trees.
#include "shared/ray_types.h"

// One work-item per ray: hits [rayCount] are replaced by those of `others` [rayCount] where these are nearer.
__kernel void keepNearer(const uint rayCount, __global const Hit* others, __global Hit* hits) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Hit hit = hits[i], other = others[i];
  if (other.triangle == PRELIGHT_NO_TRIANGLE) return;
  if (hit.triangle == PRELIGHT_NO_TRIANGLE || other.t < hit.t || (other.t == hit.t && other.triangle < hit.triangle))
    hits[i] = other;
}

// One work-item per shadow ray: hits [rayCount] of one tree become those of both; `others` [rayCount] are those of the
// other tree.
__kernel void joinShadows(const uint rayCount, __global const Hit* others, __global Hit* hits) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Hit hit = hits[i], other = others[i];
  const bool arrives = hit.triangle >= PRELIGHT_PAST_PANES && other.triangle >= PRELIGHT_PAST_PANES;
  const Hit joint = {hit.t * other.t, min(hit.triangle, other.triangle), hit.u * other.u, hit.v * other.v};
  const Hit blocked = {0.0f, 0u, 0.0f, 0.0f};
  hits[i] = arrives ? joint : blocked;
}
