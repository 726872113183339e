// Sums over the lanes of a vector.
#ifndef PRELIGHT_CORE_LANES_FUNCS_CL
#define PRELIGHT_CORE_LANES_FUNCS_CL

#include "core/inline.h"

PRELIGHT_INLINE float sumOf(float8 x) {
  const float4 four = x.lo + x.hi;
  const float2 two = four.lo + four.hi;
  return two.x + two.y;
}

#endif
