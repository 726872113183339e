// Traversal of complete binary trees of boxes.
#ifndef PRELIGHT_PHOTON_LEAF_TREE_FUNCS_CL
#define PRELIGHT_PHOTON_LEAF_TREE_FUNCS_CL

#include "shared/density_types.h"

// Returns the node after `node`, from left to right, when its children have been visited or are skipped; 1 when none is
// left.
uint nodeAfter(uint node) {
  const uint next = node + 1u;
  return next >> (31u - clz(next & -next));
}

// Returns the squared distance of a point from a box; 0 inside.
float squaredDistanceToBox(float3 p, float3 lower, float3 upper) {
  const float3 d = fmax(fmax(lower - p, p - upper), 0.0f);
  return dot(d, d);
}

#endif
