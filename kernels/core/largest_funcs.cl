// OpenCL C and GLSL.
#ifndef PRELIGHT_CORE_LARGEST_FUNCS_CL
#define PRELIGHT_CORE_LARGEST_FUNCS_CL

#include "core/dialect.h"

// Returns the largest component.
PRELIGHT_INLINE float largest(vec3 v) { return MAX(v.x, MAX(v.y, v.z)); }

#endif
