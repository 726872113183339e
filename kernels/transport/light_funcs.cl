// Light from all of a scene's lights: sampleLight, evalLight and pdfLight for a direction from which light comes;
// emitLight of transport/emission_funcs.cl samples light as it leaves the same lights.
// Options: those of transport/light_table_funcs.cl.
#ifndef PRELIGHT_TRANSPORT_LIGHT_FUNCS_CL
#define PRELIGHT_TRANSPORT_LIGHT_FUNCS_CL

#include "core/punctual_funcs.cl"
#include "transport/emitter_funcs.cl"
#include "transport/profile_funcs.cl"
#include "transport/sky_funcs.cl"

#ifdef PRELIGHT_PUNCTUAL
// u: where a light of a size is sampled, in [0,1)^2.
PRELIGHT_INLINE bool samplePunctual(Lights l, uint index, float3 point, float2 u, LightSample* a) {
  __global const PunctualLight* light = l.punctual + index;
  float falloff;
  if (!seePunctual(light, point, &a->direction, &a->distance, &falloff)) return false;
  a->punctual = true;
  a->surface = false;
  a->pdf = 1.0f;
#ifdef PRELIGHT_PROFILES
  if (light->kind == PRELIGHT_PROFILED_LIGHT) {
    falloff *= profileIntensity(l.profiles, (int)light->profile, vload3(0, light->direction), light->profileStart, -a->direction);
    if (!(falloff > 0.0f)) return false;
  }
#endif
  spreadOverDisk(light, u, a->distance, &a->direction, &falloff);
  a->radiance = falloff * vload3(0, light->intensity);
  return true;
}
#endif

// Chooses a light at random and samples a direction towards it. `choice` selects light and emitter, `place` the point
// on it or in the sky, all in 2^32. The groups' order: punctual lights, then the emitters as one, then the sky. Returns
// false when no light arrives.
PRELIGHT_INLINE bool sampleLight(Lights l, __constant const LightLayout* layout, PathScene s, float3 point, uint2 choice,
                                 uint2 place, LightSample* a) {
  float probability, remainder;
  const uint group = chooseEntry(l.tables, layout->groupCount, choice.x, &probability, &remainder);
  bool arrives = false;
  uint next = layout->emitterGroup;
#ifdef PRELIGHT_PUNCTUAL
  if (group < next) arrives = samplePunctual(l, group, point, (float2)(unitFloat(place.x), unitFloat(place.y)), a);
#endif
#ifdef PRELIGHT_EMITTERS
  if (group == next) arrives = sampleEmitter(l, layout, s, point, choice.y, (float2)(unitFloat(place.x), unitFloat(place.y)), a);
  ++next;
#endif
#ifdef PRELIGHT_SKY
  if (group == next) arrives = sampleSky(l, layout, place, a);
#endif
  if (arrives) a->pdf *= probability;
  return arrives;
}

// Returns the radiance that lights send along a ray; front: the side on which it meets a surface.
PRELIGHT_INLINE float3 evalLight(Lights l, __constant const LightLayout* layout, PathScene s, Ray ray, Hit hit, bool front) {
#ifdef PRELIGHT_SKY
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) return evalSky(l, layout, skyCoordinates(layout, vload3(0, ray.direction)));
#endif
#ifdef PRELIGHT_EMITTERS
  if (hit.triangle != PRELIGHT_NO_TRIANGLE && isEmitter(l, hit.triangle))
    return emittedRadiance(s, hit.triangle, hit.u, hit.v, front, vload3(0, ray.direction));
#endif
  return (float3)(0.0f);
}

// Returns the density, 1/sr, with which sampleLight draws a ray's direction at the ray's origin; cosine: that with
// which it meets a surface.
PRELIGHT_INLINE float pdfLight(Lights l, __constant const LightLayout* layout, Ray ray, Hit hit, float cosine) {
#ifdef PRELIGHT_SKY
  if (hit.triangle == PRELIGHT_NO_TRIANGLE)
    return pdfSky(l, layout, skyCoordinates(layout, vload3(0, ray.direction))) *
           entryProbability(l.tables, layout->groupCount, layout->groupCount - 1u);
#endif
#ifdef PRELIGHT_EMITTERS
  if (hit.triangle != PRELIGHT_NO_TRIANGLE && isEmitter(l, hit.triangle))
    return pdfEmitter(emitterDensity(l, hit.triangle, hit.u, hit.v), hit.t, cosine) * entryProbability(l.tables, layout->groupCount, layout->emitterGroup);
#endif
  return 0.0f;
}

#endif
