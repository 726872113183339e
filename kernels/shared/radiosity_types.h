// Elements of radiosity as kernels see them.
#ifndef PRELIGHT_SHARED_RADIOSITY_TYPES_H
#define PRELIGHT_SHARED_RADIOSITY_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// "No element": what a ray that left the scene met.
#define PRELIGHT_ESCAPED 0xffffffffu

/// Work-items that find the greatest residual together.
#define PRELIGHT_SOUTHWELL_ITEMS 64

/// Shadow rays of points, one after the other.
typedef struct DirectRays {
  uint points;
  uint punctual;        ///< rays a point, one to each light
  uint emitterSamples;  ///< rays a point
  uint skySamples;      ///< rays a point
} DirectRays;

/// Southwell's relaxation by a launch.
typedef struct RelaxStep {
  uint count;    ///< elements
  uint steps;    ///< relaxations at most
  float enough;  ///< W of the strongest channel: less is not worth sending
  uint perSide;  ///< elements of the fronts
} RelaxStep;

/// A point of an element.
typedef struct ElementPoint {
  uint triangle;
  float u;    ///< barycentric weight of the triangle's vertex 1
  float v;    ///< of vertex 2
  uint back;  ///< 1: it looks along the back
} ElementPoint;

PRELIGHT_SHARED_END

#endif
