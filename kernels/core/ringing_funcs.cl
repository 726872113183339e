// Light of skies in few bands, which ring. OpenCL C and GLSL; host/relight/sky_ringing.h is the same in C++.
#ifndef PRELIGHT_CORE_RINGING_FUNCS_CL
#define PRELIGHT_CORE_RINGING_FUNCS_CL

#include "core/dialect.h"

// Returns a sky's light, which rings where little of it arrives: no less than a share of that of the sky smoothed until it is negative
// nowhere, which is above 0 wherever any of it arrives.
PRELIGHT_INLINE vec3 withoutRinging(vec3 light, vec3 smoothed) { return MAX(light, 0.25f * smoothed); }

#endif
