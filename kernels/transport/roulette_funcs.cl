// Russian roulette: paths end by chance, and those that go on stand for them.
#ifndef PRELIGHT_TRANSPORT_ROULETTE_FUNCS_CL
#define PRELIGHT_TRANSPORT_ROULETTE_FUNCS_CL

#include "core/inline.h"

// Whether a path goes on that does so with a probability of `survival`. What it carries grows accordingly. `chance` is in [0,1).
PRELIGHT_INLINE bool survives(float survival, float chance, float3* carried) {
  if (!(survival > 0.0f) || chance >= survival) return false;
  *carried /= survival;
  return true;
}

#endif
