// Lights that a bake keeps apart: groups of punctual lights and of emissive triangles.
#ifndef PRELIGHT_SHARED_LIGHT_GROUP_TYPES_H
#define PRELIGHT_SHARED_LIGHT_GROUP_TYPES_H

#include "shared/compat.h"
#include "shared/shade_types.h"

PRELIGHT_SHARED_BEGIN

/// One of the shadow rays that every receiver sends: towards a punctual light, or a point of a group's
/// emitters.
typedef struct LightRay {
  uint group;
  uint light;             ///< punctual light; PRELIGHT_NO_EMITTER: emitters
  EmitterRange emitters;  ///< of the group's
  uint sample;            ///< number among the group's emitter samples
  uint sampleCount;       ///< emitter samples of the group
  uint pad;
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
  uint emitterOfTriangle;  ///< uint [triangle] in the light tables, or PRELIGHT_NO_EMITTER; of whole ones
                           ///< alone
  uint samplesOfGroup;     ///< uint [group]
  uint emitters;           ///< GroupEmitter [emitter of the light tables]
} LightGroupLayout;

/// What an emissive triangle, or a part of one, brings to its group.
typedef struct GroupEmitter {
  uint group;
  float factor[3];  ///< its radiance over the group's colour
} GroupEmitter;

PRELIGHT_SHARED_END

#endif
