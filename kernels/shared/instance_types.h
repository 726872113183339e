// Instances of shapes: the upper level of a two-level tree.
#ifndef PRELIGHT_SHARED_INSTANCE_TYPES_H
#define PRELIGHT_SHARED_INSTANCE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// Where a shape stands, and which part of the shared buffers is its own.
typedef struct DeviceInstance {
  float toObject[3][4];  ///< rows of the matrix that takes a point of the world to the shape's space
  uint firstNode;        ///< of the shape's nodes, which count from 0 again
  uint firstLeaf;        ///< of the shape's triangles in the order of its leaves
  uint firstTriangle;    ///< added to the triangle of a hit
  uint triangleCount;
} DeviceInstance;

PRELIGHT_SHARED_END

#endif
