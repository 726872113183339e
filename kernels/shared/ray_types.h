// Rays and hits as they lie in device buffers.
#ifndef PRELIGHT_SHARED_RAY_TYPES_H
#define PRELIGHT_SHARED_RAY_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// No triangle: a hit's value for a miss, and a ray source's value when no triangle is skipped.
#define PRELIGHT_NO_TRIANGLE 0xffffffffu

/// Value of a shadow ray's hit when nothing opaque is in the way but thin glass is.
#define PRELIGHT_PAST_PANES 0xfffffffeu

/// A ray in scene coordinates.
typedef struct Ray {
  float origin[3];
  uint sourceTriangle;  ///< never hit by this ray
  float direction[3];   ///< any length but 0; t counts in its units
  float tMax;           ///< only hits at t in [0, tMax] count
} Ray;

/// A ray's hit, or a miss. core/shadow_share_funcs.cl says how the hits of shadow rays are read.
typedef struct Hit {
  float t;
  uint triangle;  ///< PRELIGHT_NO_TRIANGLE: a miss, the other fields are 0
  float u;        ///< barycentric weight of the triangle's vertex 1, in [0,1]
  float v;        ///< barycentric weight of vertex 2
} Hit;

PRELIGHT_SHARED_END

#endif
