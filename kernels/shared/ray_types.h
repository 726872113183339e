// Rays and hits as they lie in device buffers.
#ifndef PRELIGHT_SHARED_RAY_TYPES_H
#define PRELIGHT_SHARED_RAY_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// "No triangle": of a hit, a miss; of a ray's source, nothing to skip.
#define PRELIGHT_NO_TRIANGLE 0xffffffffu

/// Of a shadow ray's hit: nothing opaque is in the way, but thin glass is.
#define PRELIGHT_PAST_PANES 0xfffffffeu

typedef struct Ray {
  float origin[3];
  uint sourceTriangle;  ///< never hit by this ray
  float direction[3];   ///< any length but 0; t counts in its units
  float tMax;           ///< hits at t in [0, tMax]
} Ray;

typedef struct Hit {
  float t;
  uint triangle;  ///< PRELIGHT_NO_TRIANGLE: a miss, the other fields are 0
  float u;        ///< barycentric weight of the triangle's vertex 1, in [0,1]
  float v;        ///< of vertex 2
} Hit;

PRELIGHT_SHARED_END

#endif
