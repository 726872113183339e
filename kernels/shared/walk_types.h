// Walks of light within bodies that scatter it (transport/walk_funcs.cl).
#ifndef PRELIGHT_SHARED_WALK_TYPES_H
#define PRELIGHT_SHARED_WALK_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

typedef struct MediumWalk {
  float weight[3];  ///< what it carries
  uint origin;      ///< number of the ray that it began with
  uint medium;      ///< material; PRELIGHT_NO_MEDIUM: the ray does not walk
  float reach;      ///< m; where light is scattered next if no surface is nearer; MAXFLOAT: nowhere
  uint seed;        ///< of what is drawn next
  uint steps;       ///< scattered so often
} MediumWalk;

PRELIGHT_SHARED_END

#endif
