// Vectors, and orthonormal frames in which they are expressed.
#ifndef PRELIGHT_CORE_VECTOR_FUNCS_CL
#define PRELIGHT_CORE_VECTOR_FUNCS_CL

#include "core/inline.h"
#include "core/sampling_funcs.cl"
#include "core/largest_funcs.cl"

// An orthonormal frame.
typedef struct Frame {
  float3 x, y, z;
} Frame;

PRELIGHT_INLINE Frame frameAround(float3 n) {
  Frame f;
  f.z = n;
  makeFrame(n, &f.x, &f.y);
  return f;
}

PRELIGHT_INLINE float3 toFrame(Frame f, float3 d) { return (float3)(dot(d, f.x), dot(d, f.y), dot(d, f.z)); }
PRELIGHT_INLINE float3 fromFrame(Frame f, float3 d) { return d.x * f.x + d.y * f.y + d.z * f.z; }

#endif
