// Receivers' ways to lights: shadow rays that tell whether what a light would bring arrives.
#ifndef PRELIGHT_TRANSPORT_AIM_FUNCS_CL
#define PRELIGHT_TRANSPORT_AIM_FUNCS_CL

#include "core/inline.h"
#include "core/punctual_funcs.cl"
#include "shared/cast_types.h"
#include "shared/ray_types.h"

// Share of the distance to a light that a shadow ray goes: the light's own surface is no obstacle.
#define PRELIGHT_SHADOW_REACH 0.9999f

typedef struct Aim {
  float3 way;    // from the receiver; a shadow ray's direction
  float reach;   // in lengths of `way`
  float3 value;  // what arrives, in the caller's units, if nothing is in the way
} Aim;

// share: irradiance of a light of intensity 1. False: nothing arrives.
PRELIGHT_INLINE bool aimAtPunctual(__global const PunctualLight* light, float3 point, float3 normal, Aim* aim,
                                   float* share) {
  float3 direction;
  float distance, falloff;
  if (!seePunctual(light, point, &direction, &distance, &falloff)) return false;
  const float cosine = dot(direction, normal);
  if (cosine <= 0.0f) return false;
  const bool afar = distance == MAXFLOAT;
  aim->way = afar ? direction : direction * distance;
  aim->reach = afar ? MAXFLOAT : PRELIGHT_SHADOW_REACH;
  *share = cosine * falloff;
  return true;
}

// A point of a triangle by the weights of its vertices 1 and 2. A shadow ray ends short of it by more than its rounding.
PRELIGHT_INLINE float3 pointBetween(float3 a, float3 b, float3 c, float2 weights) {
  return a + weights.x * (b - a) + weights.y * (c - a);
}

// The shadow ray; one that meets nothing where nothing can arrive.
PRELIGHT_INLINE Ray shadowRay(__global const Receiver* receiver, Aim aim, bool arrives) {
  Ray ray;
  vstore3(vload3(0, receiver->position), 0, ray.origin);
  vstore3(arrives ? aim.way : vload3(0, receiver->normal), 0, ray.direction);
  ray.sourceTriangle = receiver->triangle;
  ray.tMax = arrives ? aim.reach : 0.0f;
  return ray;
}

#endif
