// Lights that a bake keeps apart: groups of punctual lights and of emissive triangles.
#ifndef PRELIGHT_SHARED_LIGHT_GROUP_TYPES_H
#define PRELIGHT_SHARED_LIGHT_GROUP_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_NO_EMITTER 0xffffffffu

/// One of the shadow rays that every receiver sends: towards a punctual light, or a point of a group's
/// emitters.
typedef struct LightRay {
  uint group;
  uint light;         ///< punctual light; PRELIGHT_NO_EMITTER: emitters
  uint firstEmitter;  ///< of the group's
  uint emitterCount;
  uint sample;       ///< number among the group's emitter samples
  uint sampleCount;  ///< emitter samples of the group
  uint pad[2];
} LightRay;

/// 64 bytes of a buffer of arrays, as SurfaceLine.
typedef struct LightGroupLine {
  uint words[16];
} LightGroupLine;

/// Groups of lights, and the first LightGroupLine of each array.
typedef struct LightGroupLayout {
  uint rayCount;
  uint groupCount;
  uint rays;               ///< LightRay [ray]
  uint punctual;           ///< PunctualLight [light]
  uint factors;            ///< float [light][3], intensity over the group's colour
  uint emitterOfTriangle;  ///< uint [triangle] GroupEmitter, or PRELIGHT_NO_EMITTER
  uint samplesOfGroup;     ///< uint [group]
  uint positions;          ///< float [vertex][3]
  uint normals;            ///< float [triangle][3] of the fronts, unit
} LightGroupLayout;

/// An emissive triangle.
typedef struct GroupEmitter {
  uint triangle;
  uint group;
  float bound;      ///< end of its interval in [0,1], ascending within the group; the last is 1
  float density;    ///< 1/m2 with which a point of it is drawn
  float factor[3];  ///< its radiance over the group's colour
  uint twoSided;
} GroupEmitter;

PRELIGHT_SHARED_END

#endif
