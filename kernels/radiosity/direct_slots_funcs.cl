// Rays that a point sends to lights.
#ifndef PRELIGHT_RADIOSITY_DIRECT_SLOTS_FUNCS_CL
#define PRELIGHT_RADIOSITY_DIRECT_SLOTS_FUNCS_CL

#include "shared/radiosity_types.h"

uint slotsOf(DirectRays counts) { return counts.punctual + counts.emitterSamples + counts.skySamples; }

#endif
