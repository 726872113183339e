// The lights of a scene, and the tables by which one is chosen in proportion to its power.
// Options: PRELIGHT_PUNCTUAL, PRELIGHT_EMITTERS, PRELIGHT_SKY (the scene has such lights); PRELIGHT_PROFILES (punctual
// lights have profiles); PRELIGHT_EMITTER_PARTS (some emissive triangle is uneven, and has parts).
#ifndef PRELIGHT_TRANSPORT_LIGHT_TABLE_FUNCS_CL
#define PRELIGHT_TRANSPORT_LIGHT_TABLE_FUNCS_CL

#include "core/inline.h"
#include "shared/shade_types.h"

// A scene's lights and their tables in their buffers.
typedef struct Lights {
  // Lower bounds in 2^32: groups, emitters, sky rows, sky columns per row, profiles.
  __global const uint* tables;
  __global const uint* emitters;           // [emitter] triangle
  // [triangle], with parts [emitter]: density, 1/m2, with which a point of it is drawn; 0: no emitter.
  __global const float* emitterDensities;
#ifdef PRELIGHT_EMITTER_PARTS
  __global const float4* emitterParts;      // [emitter] weights of vertices 1 and 2 at its corner, size of its edges
  __global const float4* emitterRadiances;  // [emitter] mean radiance
  __global const uint* emitterRoots;        // [triangle] reference: PRELIGHT_NO_EMITTER, | PRELIGHT_EMITTER_LEAF an emitter, or a node
  __global const uint* emitterNodes;        // [node][4] references
#endif
  __global const PunctualLight* punctual;
  __global const float4* sky;  // [row][column] radiance
#ifdef PRELIGHT_PROFILES
  __global const float4* profiles;
#endif
} Lights;

// Light that arrives at a point from a light, without occlusion.
typedef struct LightSample {
  float3 direction;  // unit
  float distance;    // MAXFLOAT for distant lights
  float3 target;     // point of the surface from which the light comes, if any
  float3 radiance;   // for punctual lights: irradiance on a surface that faces the light
  float pdf;         // density of the direction, 1/sr; 1 for a light that has only one direction
  bool punctual;     // the light is punctual: no ray can meet it by chance
  bool surface;
} LightSample;

PRELIGHT_INLINE EmitterRange allEmitters(__constant const LightLayout* layout) {
  const EmitterRange range = {0u, layout->emitterCount, layout->emitterTable};
  return range;
}

// Returns the entry whose interval contains `bits`. Bounds ascend from 0; the last interval ends at 2^32; none is
// empty.
// remainder in (0,1): position within the interval.
PRELIGHT_INLINE uint chooseEntry(__global const uint* bounds, uint count, uint bits, float* probability, float* remainder) {
  uint low = 0u, high = count;
  while (high - low > 1u) {
    const uint middle = low + (high - low) / 2u;
    if (bounds[middle] <= bits)
      low = middle;
    else
      high = middle;
  }
  const uint width = (low + 1u < count ? bounds[low + 1u] : 0u) - bounds[low];  // 0: all of 2^32
  const float size = width == 0u ? 4294967296.0f : (float)width;
  *probability = size * 2.3283064e-10f;
  *remainder = fmin(((float)(bits - bounds[low]) + 0.5f) / size, 0.99999994f);
  return low;
}

PRELIGHT_INLINE float entryProbability(__global const uint* bounds, uint count, uint entry) {
  const uint width = (entry + 1u < count ? bounds[entry + 1u] : 0u) - bounds[entry];
  return width == 0u ? 1.0f : (float)width * 2.3283064e-10f;
}

#endif
