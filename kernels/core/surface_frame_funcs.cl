// Tangent frames of surfaces (host/scene/surface/surface_frame.h). OpenCL C and GLSL.
#ifndef PRELIGHT_CORE_SURFACE_FRAME_FUNCS_CL
#define PRELIGHT_CORE_SURFACE_FRAME_FUNCS_CL

#include "core/dialect.h"

// Returns a unit tangent of a unit normal; the bitangent is cross(normal, tangent).
vec3 surfaceTangent(vec3 n) {
  const vec3 axis = VEC3(0.36f, 0.48f, 0.8f);
  const vec3 across = VEC3(0.8f, -0.6f, 0.0f);
  vec3 tangent = axis - dot(axis, n) * n;
  if (dot(tangent, tangent) < 1e-8f) tangent = across - dot(across, n) * n;
  return normalize(tangent);
}

#endif
