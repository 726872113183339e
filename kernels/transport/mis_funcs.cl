// Weights of two sampling strategies for the same light.
#ifndef PRELIGHT_TRANSPORT_MIS_FUNCS_CL
#define PRELIGHT_TRANSPORT_MIS_FUNCS_CL

#include "core/inline.h"

// Returns the power heuristic (Veach 1995, eq. 9.13) for a sample of density `used` that the other strategy draws with
// `other`.
PRELIGHT_INLINE float misWeight(float used, float other) {
  const float ratio = other / used;
  return 1.0f / (1.0f + ratio * ratio);
}

#endif
