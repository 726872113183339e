// Walks of light within bodies that scatter it (transport/walk_funcs.cl).
#ifndef PRELIGHT_SHARED_WALK_TYPES_H
#define PRELIGHT_SHARED_WALK_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

typedef struct MediumWalk {
  float weight[3];  ///< throughput, rgb
  uint origin;      ///< index of the ray with which it began
  uint medium;      ///< material; PRELIGHT_NO_MEDIUM: the ray does not walk
  float reach;      ///< m; distance of the next scattering if no surface is nearer; MAXFLOAT: none
  uint seed;        ///< seed of its random numbers
  uint steps;       ///< number of scatterings
} MediumWalk;

PRELIGHT_SHARED_END

#endif
