// Light groups: the punctual lights and emissive triangles that a bake keeps apart.
#ifndef PRELIGHT_SHARED_LIGHT_GROUP_TYPES_H
#define PRELIGHT_SHARED_LIGHT_GROUP_TYPES_H

#include "shared/compat.h"
#include "shared/shade_types.h"

PRELIGHT_SHARED_BEGIN

/// One of the shadow rays that every receiver sends: towards a punctual light, or a point of a group's
/// emitters.
typedef struct LightRay {
  uint group;
  uint light;             ///< punctual light, or PRELIGHT_NO_EMITTER for emitters
  EmitterRange emitters;  ///< the group's emitters
  uint sample;            ///< index among the group's emitter samples
  uint sampleCount;       ///< number of the group's emitter samples
  uint pad;
} LightRay;

/// 64 bytes of a buffer of arrays, like SurfaceLine.
typedef struct LightGroupLine {
  uint words[16];
} LightGroupLine;

/// Groups of lights, and the first LightGroupLine of each array.
typedef struct LightGroupLayout {
  uint rayCount;
  uint groupCount;
  uint rays;  ///< LightRay [ray]
  /// uint [triangle] emitter in the light tables, or PRELIGHT_NO_EMITTER; of undivided triangles only.
  uint emitterOfTriangle;
  uint samplesOfGroup;  ///< uint [group]
  uint emitters;        ///< GroupEmitter [emitter of the light tables]
} LightGroupLayout;

/// The group of an emissive triangle, or of a part of one, and its radiance.
typedef struct GroupEmitter {
  uint group;
  float factor[3];  ///< radiance divided by the group's colour
} GroupEmitter;

PRELIGHT_SHARED_END

#endif
