// Instances of shapes: the leaves of a two-level tree's upper level.
#ifndef PRELIGHT_SHARED_INSTANCE_TYPES_H
#define PRELIGHT_SHARED_INSTANCE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// The place of a shape in the scene, and its tree. A point p of the scene is toShape (p - centre) in the
/// shape's space: near the surface the difference is nearly exact, however far the instance is from the
/// scene's centre.
typedef struct DeviceInstance {
  float toShape[3][3];  ///< rows
  float centre[3];
  uint root;           ///< root node
  uint firstTriangle;  ///< added to the triangle index of a hit
  uint triangleCount;
  uint pad;
} DeviceInstance;

PRELIGHT_SHARED_END

#endif
