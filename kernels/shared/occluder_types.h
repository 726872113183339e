// Vector occluders: what receivers see of each.
#ifndef PRELIGHT_SHARED_OCCLUDER_TYPES_H
#define PRELIGHT_SHARED_OCCLUDER_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// A vertex as occluders are seen by it.
typedef struct OccluderVertex {
  float position[3];
  float accessibility;  ///< AO in [0,1]
  float normal[3];      ///< unit
  uint group;           ///< occluder
} OccluderVertex;

/// What a receiver's rays met of one occluder: sums over rays, divided by the number of all its rays.
typedef struct OccluderSums {
  float formFactor;
  float direction[3];
  float offset[3];      ///< from the receiver to what was hit, m
  float distance;       ///< m
  float normal[3];      ///< of fronts, weighted by their accessibility
  float accessibility;  ///< of fronts
  float color[3];       ///< diffuse albedo
  uint group;
} OccluderSums;

PRELIGHT_SHARED_END

#endif
