// Reading of shadow rays' hits (Tracer::traceShadows).
// Options: PRELIGHT_SHADOW_SHARES (some surface lets part of the light through; otherwise all of it arrives or none).
#ifndef PRELIGHT_CORE_SHADOW_SHARE_FUNCS_CL
#define PRELIGHT_CORE_SHADOW_SHARE_FUNCS_CL

#include "core/inline.h"
#include "shared/ray_types.h"

// Returns true when the light came through thin glass, through which only shadow rays can pass.
PRELIGHT_INLINE bool isPastPanes(Hit shadow) {
#ifdef PRELIGHT_SHADOW_SHARES
  return shadow.triangle == PRELIGHT_PAST_PANES;
#else
  return false;
#endif
}

// Returns false when no light arrives.
PRELIGHT_INLINE bool lightArrives(Hit shadow) { return shadow.triangle == PRELIGHT_NO_TRIANGLE || isPastPanes(shadow); }

// Returns the share of the light that arrives, rgb. Valid where lightArrives is true.
PRELIGHT_INLINE float3 shadowShare(Hit shadow) {
#ifdef PRELIGHT_SHADOW_SHARES
  return (float3)(shadow.t, shadow.u, shadow.v);
#else
  return (float3)(1.0f);
#endif
}

#endif
