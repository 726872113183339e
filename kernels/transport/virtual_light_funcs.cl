// Virtual point lights (Keller 1997): diffuse surfaces that light paths have met, as lights. Bumps of a clear coat are
// ignored.
// Options: those of transport/lobe_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_VIRTUAL_LIGHT_FUNCS_CL
#define PRELIGHT_TRANSPORT_VIRTUAL_LIGHT_FUNCS_CL

#include "shared/reference_types.h"
#include "transport/interaction_funcs.cl"
#include "transport/layer_funcs.cl"

// Light that a virtual light sends to a point, without occlusion.
typedef struct VirtualSample {
  float3 direction;  // towards the light, unit
  float3 intensity;  // W/sr
  float falloff;     // share of it that arrives as irradiance on a surface that faces the light
} VirtualSample;

// Returns the virtual light of a surface that diffusely scatters power arriving from i.wo.
PRELIGHT_INLINE VirtualLight virtualLightAt(Interaction i, Bsdf b, float3 power) {
#ifdef PRELIGHT_BUMPS
  const float3 normal = b.bumped ? i.geometric : i.frame.z;  // as in asFoundBy()
#else
  const float3 normal = i.frame.z;
#endif
  const float arrives = fmax(bodyCosine(b, i.woLocal), 0.0f);
  const float enters = passage(b, (float3)(i.woLocal.x, i.woLocal.y, arrives)) * b.bodyGain;
  // The half of the adjoint (adjointRatio) for the arriving direction; sampleVirtual applies the other half.
  const float bent = arrives / fmax(dot(i.wo, i.geometric), 1e-6f);
  VirtualLight light;
  vstore3(i.position, 0, light.position);
  light.triangle = i.triangle;
  vstore3(normal, 0, light.normal);
  light.layerF0 = b.layer.x;
  light.layerF90 = b.layer.y;
  light.layerLater = b.layer.z;
  light.roughness = b.roughness;
  light.coat = light.coatRoughness = light.sheen = light.sheenRoughness = 0.0f;
#ifdef PRELIGHT_LAYERS
  light.coat = b.coat;
  light.coatRoughness = b.coatRoughness;
  light.sheen = largest(b.sheen);
  light.sheenRoughness = b.sheenRoughness;
#endif
  vstore3(power * b.diffuse * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.intensity);
  vstore3((float3)(0.0f), 0, light.through);
#ifdef PRELIGHT_TRANSLUCENT
  vstore3(power * b.transmitted * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.through);
#endif
  vstore3(i.geometric, 0, light.geometric);
  light.nearby = 0.0f;
  return light;
}

// Returns the share of the light inside the body of a virtual light that leaves in a direction of this cosine.
PRELIGHT_INLINE float leavesVirtual(PathScene s, VirtualLight light, float cosine) {
  Bsdf b;
  b.layer = (float3)(light.layerF0, light.layerF90, light.layerLater);
  b.roughness = light.roughness;
  b.smooth = light.roughness < PRELIGHT_SMOOTH_BELOW;
  b.albedos = s.albedos;
#ifdef PRELIGHT_FILM
  b.film.share = 0.0f;  // the film's colour on the way out is not stored
#endif
#ifdef PRELIGHT_ANISOTROPY
  b.alphas = (float2)(light.roughness * light.roughness);  // the direction of anisotropy is not stored
#endif
  float left = 1.0f;
#ifdef PRELIGHT_LAYERS
  // Light that leaves passes the coat and the sheen; arriving light is not scaled (transport/layer_funcs.cl).
  b.coat = light.coat;
  b.coatRoughness = light.coatRoughness;
  b.coatSmooth = b.coatRoughness < PRELIGHT_SMOOTH_BELOW;
  b.sheen = (float3)(light.sheen);
  b.sheenRoughness = light.sheenRoughness;
  if (light.coat > 0.0f || light.sheen > 0.0f) left = belowLayers(b, cosine, cosine);
#endif
  return left * passage(b, (float3)(0.0f, 0.0f, cosine));
}

// Samples a virtual light at a point. A light nearer than the square root of `leastSquare` counts as at that distance,
// with the gain of light.nearby. Returns false when no light arrives.
PRELIGHT_INLINE bool sampleVirtual(PathScene s, VirtualLight light, float3 point, float leastSquare, VirtualSample* sample) {
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
  const float given = 1.0f + light.nearby * fmax(1.0f - square / leastSquare, 0.0f);
  sample->falloff = leaving * leavesVirtual(s, light, cosine) * given / fmax(square, leastSquare);
  return true;
}

#endif
