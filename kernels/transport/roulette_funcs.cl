// Russian roulette: some paths end at random, and those that go on are weighted to stand for them.
#ifndef PRELIGHT_TRANSPORT_ROULETTE_FUNCS_CL
#define PRELIGHT_TRANSPORT_ROULETTE_FUNCS_CL

#include "core/inline.h"

// Returns true when a path with a survival probability of `survival` goes on; its throughput grows accordingly.
// `chance` is in [0,1).
PRELIGHT_INLINE bool survives(float survival, float chance, float3* carried) {
  if (!(survival > 0.0f) || chance >= survival) return false;
  *carried /= survival;
  return true;
}

#endif
