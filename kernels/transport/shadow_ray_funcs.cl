// Shadow rays from receivers, which test whether the light of a sample arrives.
// Options: those of transport/light_table_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_SHADOW_RAY_FUNCS_CL
#define PRELIGHT_TRANSPORT_SHADOW_RAY_FUNCS_CL

#include "core/inline.h"
#include "shared/cast_types.h"
#include "shared/ray_types.h"
#include "transport/light_table_funcs.cl"

// Share of the distance to a light over which a shadow ray is traced: the light's own surface is no obstacle.
#define PRELIGHT_SHADOW_REACH 0.9999f

// Returns the shadow ray of a sample, or one that hits nothing where no light can arrive.
PRELIGHT_INLINE Ray shadowRay(__global const Receiver* receiver, LightSample a, bool arrives) {
  const float3 origin = vload3(0, receiver->position);
  float3 way = vload3(0, receiver->normal);
  float reach = 0.0f;
  if (arrives) {
    const bool afar = a.distance == MAXFLOAT;
    way = a.surface ? a.target - origin : (afar ? a.direction : a.direction * a.distance);
    reach = afar ? MAXFLOAT : PRELIGHT_SHADOW_REACH;
  }
  Ray ray;
  vstore3(origin, 0, ray.origin);
  vstore3(way, 0, ray.direction);
  ray.sourceTriangle = receiver->triangle;
  ray.tMax = reach;
  return ray;
}

#endif
