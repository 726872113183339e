// Light of punctual lights (KHR_lights_punctual).
#ifndef PRELIGHT_CORE_PUNCTUAL_FUNCS_CL
#define PRELIGHT_CORE_PUNCTUAL_FUNCS_CL

#include "shared/shade_types.h"

// Writes the unit direction and the distance (MAXFLOAT for directional lights) from a point to a light, and the factor
// that turns its intensity into irradiance on a surface that faces it, without occlusion. Returns false when no light
// arrives.
bool seePunctual(__global const PunctualLight* light, float3 point, float3* direction, float* distance, float* falloff) {
  const float3 travel = vload3(0, light->direction);
  if (light->kind == PRELIGHT_DIRECTIONAL_LIGHT) {
    *direction = -travel;
    *distance = MAXFLOAT;
    *falloff = 1.0f;
    return true;
  }
  const float3 way = vload3(0, light->position) - point;
  const float metres = length(way);
  if (!(metres > 1e-9f)) return false;  // a nanometre: the light lies on the surface
  *direction = way / metres;
  *distance = metres;
  const float ratio = metres * light->inverseRange;
  *falloff = clamp(1.0f - ratio * ratio * ratio * ratio, 0.0f, 1.0f) / (metres * metres);
  if (light->kind == PRELIGHT_SPOT_LIGHT) {
    const float angular = clamp(-dot(*direction, travel) * light->coneScale + light->coneOffset, 0.0f, 1.0f);
    *falloff *= angular * angular;
  }
  return *falloff > 0.0f;
}

#endif
