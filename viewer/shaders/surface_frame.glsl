// The frame of a place on a surface, of a unit normal: tangent, bitangent, normal.
#ifndef SURFACE_FRAME_GLSL
#define SURFACE_FRAME_GLSL

#include "core/surface_frame_funcs.cl"

mat3 surfaceFrame(vec3 n) {
  vec3 tangent = surfaceTangent(n);
  return mat3(tangent, cross(n, tangent), n);
}

#endif
