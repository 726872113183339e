// Virtual point lights (Keller 1997): diffuse surfaces that light paths have met, as lights.
// Options: those of transport/lobe_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_VIRTUAL_LIGHT_FUNCS_CL
#define PRELIGHT_TRANSPORT_VIRTUAL_LIGHT_FUNCS_CL

#include "shared/reference_types.h"
#include "transport/interaction_funcs.cl"
#include "transport/lobe_funcs.cl"

// What a virtual light sends to a point, were nothing in the way.
typedef struct VirtualSample {
  float3 direction;  // towards the light, unit
  float3 intensity;  // W/sr
  float falloff;     // part of it that arrives as irradiance on a surface that faces the light
} VirtualSample;

// The virtual light that a surface becomes as it scatters diffusely the power that comes from i.wo.
PRELIGHT_INLINE VirtualLight virtualLightAt(Interaction i, Bsdf b, float3 power) {
  const float arrives = fmax(i.woLocal.z, 0.0f);
  const float enters = 1.0f - largest(schlick(b, arrives));
  // The half of the adjoint (adjointRatio) that the way in has; sampleVirtual has the other.
  const float bent = arrives / fmax(dot(i.wo, i.geometric), 1e-6f);
  VirtualLight light;
  vstore3(i.position, 0, light.position);
  light.triangle = i.triangle;
  vstore3(i.frame.z, 0, light.normal);
  light.f0 = largest(b.f0);
  vstore3(power * b.diffuse * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.intensity);
  vstore3((float3)(0.0f), 0, light.through);
#ifdef PRELIGHT_TRANSLUCENT
  vstore3(power * b.transmitted * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.through);
#endif
  light.f90 = b.f90;
  vstore3(i.geometric, 0, light.geometric);
  light.pad = light.pad2 = 0u;
  return light;
}

// Nearer than the square root of `leastSquare` a light counts as at that distance. False: nothing arrives.
PRELIGHT_INLINE bool sampleVirtual(VirtualLight light, float3 point, float leastSquare, VirtualSample* sample) {
  const float3 way = vload3(0, light.position) - point;
  const float square = dot(way, way);
  if (!(square > 1e-18f)) return false;
  sample->direction = way * rsqrt(square);
  float cosine = -dot(sample->direction, vload3(0, light.normal)), leaving = -dot(sample->direction, vload3(0, light.geometric));
  sample->intensity = vload3(0, light.intensity);
#ifdef PRELIGHT_TRANSLUCENT
  if (cosine < 0.0f && leaving < 0.0f) {
    sample->intensity = vload3(0, light.through);
    cosine = -cosine;
    leaving = -leaving;
  }
#endif
  if (cosine <= 0.0f || leaving <= 0.0f) return false;
  const float leaves = 1.0f - (light.f0 + (light.f90 - light.f0) * schlickRise(cosine));
  sample->falloff = leaving * leaves / fmax(square, leastSquare);
  return true;
}

#endif
