// Visibility past a hit.
#ifndef PRELIGHT_PROJECT_VISIBILITY_FUNCS_CL
#define PRELIGHT_PROJECT_VISIBILITY_FUNCS_CL

#include "core/inline.h"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Returns 1 for open, 0 for blocked; with obscurance, a value in between by distance (Zhukov et al. 1998; Real-Time
// Rendering, Eq. 11.11).
PRELIGHT_INLINE float visibilityOf(__constant const CastParameters* parameters, Hit hit) {
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return 1.0f;
  if (parameters->obscurance <= 0.0f) return 0.0f;
  return fmin((parameters->nearLimit + hit.t) / parameters->obscurance, 1.0f);
}

#endif
