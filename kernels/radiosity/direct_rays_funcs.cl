// Number of rays that a point sends to lights.
#ifndef PRELIGHT_RADIOSITY_DIRECT_RAYS_FUNCS_CL
#define PRELIGHT_RADIOSITY_DIRECT_RAYS_FUNCS_CL

#include "shared/radiosity_types.h"

uint raysOf(DirectRays counts) { return counts.punctual + counts.emitterSamples + counts.skySamples; }

#endif
