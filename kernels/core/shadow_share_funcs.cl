// What a shadow ray's hit tells (Tracer::traceShadows).
// Options: PRELIGHT_SHADOW_SHARES (some surface lets part of the light through; else all of it arrives or none).
#ifndef PRELIGHT_CORE_SHADOW_SHARE_FUNCS_CL
#define PRELIGHT_CORE_SHADOW_SHARE_FUNCS_CL

#include "core/inline.h"
#include "shared/ray_types.h"

// Whether thin glass is in the way, through which no other ray than a shadow ray runs on.
PRELIGHT_INLINE bool isPastPanes(Hit shadow) {
#ifdef PRELIGHT_SHADOW_SHARES
  return shadow.triangle == PRELIGHT_PAST_PANES;
#else
  return false;
#endif
}

// False: nothing arrives.
PRELIGHT_INLINE bool lightArrives(Hit shadow) { return shadow.triangle == PRELIGHT_NO_TRIANGLE || isPastPanes(shadow); }

// Share of the light that arrives, where some does.
PRELIGHT_INLINE float3 shadowShare(Hit shadow) {
#ifdef PRELIGHT_SHADOW_SHARES
  return (float3)(shadow.t, shadow.u, shadow.v);
#else
  return (float3)(1.0f);
#endif
}

#endif
