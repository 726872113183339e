// Radiosity elements and their solver's parameters, as kernels see them.
#ifndef PRELIGHT_SHARED_RADIOSITY_TYPES_H
#define PRELIGHT_SHARED_RADIOSITY_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// Stands for no element: the ray left the scene.
#define PRELIGHT_ESCAPED 0xffffffffu

/// Work-items of the group that searches for the greatest residual.
#define PRELIGHT_SOUTHWELL_ITEMS 64

/// Shadow rays per point, in the order of the members.
typedef struct DirectRays {
  uint points;
  uint punctual;        ///< rays per point, one to each light
  uint emitterSamples;  ///< rays per point
  uint skySamples;      ///< rays per point
} DirectRays;

/// One launch of Southwell's relaxation.
typedef struct RelaxStep {
  uint count;    ///< elements
  uint steps;    ///< greatest number of relaxations
  float enough;  ///< W of the strongest channel; less is not sent
  uint perSide;  ///< elements of the fronts
} RelaxStep;

/// A point of an element.
typedef struct ElementPoint {
  uint triangle;
  float u;    ///< barycentric weight of the triangle's vertex 1
  float v;    ///< barycentric weight of vertex 2
  uint back;  ///< 1: on the back
} ElementPoint;

PRELIGHT_SHARED_END

#endif
