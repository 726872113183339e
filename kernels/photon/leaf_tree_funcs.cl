// Ways through complete binary trees of boxes.
#ifndef PRELIGHT_PHOTON_LEAF_TREE_FUNCS_CL
#define PRELIGHT_PHOTON_LEAF_TREE_FUNCS_CL

#include "shared/density_types.h"

// The node after `node` from left to right once its children are done with or left out; 1: there is none.
uint nodeAfter(uint node) {
  const uint next = node + 1u;
  return next >> (31u - clz(next & -next));
}

// Squared distance of a point from a box; 0 inside.
float squaredDistanceToBox(float3 p, float3 lower, float3 upper) {
  const float3 d = fmax(fmax(lower - p, p - upper), 0.0f);
  return dot(d, d);
}

#endif
