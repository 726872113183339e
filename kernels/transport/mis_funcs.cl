// The weights of two ways to draw the same light.
#ifndef PRELIGHT_TRANSPORT_MIS_FUNCS_CL
#define PRELIGHT_TRANSPORT_MIS_FUNCS_CL

#include "core/inline.h"

// Power heuristic (Veach 1995, eq. 9.13) for a sample of density `used`, which the other way draws with `other`.
PRELIGHT_INLINE float misWeight(float used, float other) {
  const float ratio = other / used;
  return 1.0f / (1.0f + ratio * ratio);
}

#endif
