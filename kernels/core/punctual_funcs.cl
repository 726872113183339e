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

// Turns the direction to a light of a size to a point of the disk that it is seen as, uniformly in solid angle; u: in [0,1)^2. The factor
// becomes that of the disk, which sends as much to a surface that faces its middle as a light without a size.
void spreadOverDisk(__global const PunctualLight* light, float2 u, float distance, float3* direction, float* falloff) {
  const bool directional = light->kind == PRELIGHT_DIRECTIONAL_LIGHT;
  if (!(light->radius > 0.0f) || (!directional && !(light->radius < distance))) return;
  const float sine = directional ? sin(light->radius) : light->radius / distance;
  const float lower = sine * sine / (1.0f + sqrt(fmax(1.0f - sine * sine, 0.0f)));  // 1 - cosine, which would cancel
  const float below = u.x * lower, turn = 2.0f * M_PI_F * u.y;
  const float3 axis = *direction;
  const float3 across = normalize(cross(axis, fabs(axis.x) < 0.6f ? (float3)(1.0f, 0.0f, 0.0f) : (float3)(0.0f, 1.0f, 0.0f)));
  const float aside = sqrt(below * (2.0f - below));
  *direction = normalize((1.0f - below) * axis + aside * (cos(turn) * across + sin(turn) * cross(axis, across)));
  *falloff *= 2.0f / (2.0f - lower);
}

#endif
