// The lights of a scene, and the tables that one is chosen by in proportion to its power.
// Options: PRELIGHT_PUNCTUAL, PRELIGHT_EMITTERS, PRELIGHT_SKY: the scene has such lights; PRELIGHT_PROFILES: punctual ones
// with profiles; PRELIGHT_EMITTER_PARTS: some emissive triangle is uneven, and has parts.
#ifndef PRELIGHT_TRANSPORT_LIGHT_TABLE_FUNCS_CL
#define PRELIGHT_TRANSPORT_LIGHT_TABLE_FUNCS_CL

#include "core/inline.h"
#include "shared/shade_types.h"

typedef struct Lights {
  __global const uint* tables;             // lower bounds in 2^32: groups, emitters, sky rows, sky columns a row, profiles
  __global const uint* emitters;           // [emitter] triangle
  __global const float* emitterDensities;  // [triangle] 1/m2 with which a point of it is drawn; 0: no emitter. With parts [emitter]
#ifdef PRELIGHT_EMITTER_PARTS
  __global const float4* emitterParts;      // [emitter] weights of vertices 1 and 2 at its corner, size of its edges
  __global const float4* emitterRadiances;  // [emitter] mean
  __global const uint* emitterRoots;        // [triangle] reference: PRELIGHT_NO_EMITTER, | PRELIGHT_EMITTER_LEAF an emitter, or a node
  __global const uint* emitterNodes;        // [node][4] references
#endif
  __global const PunctualLight* punctual;
  __global const float4* sky;  // [row][column] radiance
#ifdef PRELIGHT_PROFILES
  __global const float4* profiles;
#endif
} Lights;

// What arrives at a point from a light, were nothing in the way.
typedef struct LightSample {
  float3 direction;  // unit
  float distance;    // MAXFLOAT: from afar
  float3 target;     // where the light leaves, if it is a surface
  float3 radiance;   // of a punctual light: irradiance on a surface that faces it
  float pdf;         // 1/sr of the direction; 1 of a light that has only one
  bool punctual;     // no ray can meet the light by chance
  bool surface;
} LightSample;

PRELIGHT_INLINE EmitterRange allEmitters(__constant const LightLayout* layout) {
  const EmitterRange range = {0u, layout->emitterCount, layout->emitterTable};
  return range;
}

// The entry whose interval holds `bits`. Bounds ascend from 0; the last interval ends at 2^32; none is empty.
// remainder in (0,1): place within the interval.
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
