// Paths of a camera that end where they meet light which was computed beforehand.
#ifndef PRELIGHT_SHARED_CACHED_LIGHT_TYPES_H
#define PRELIGHT_SHARED_CACHED_LIGHT_TYPES_H

#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/reference_types.h"

PRELIGHT_SHARED_BEGIN

typedef struct CachedPathParameters {
  ReferenceParameters paths;
  IrradianceMapLayout indirect;
  DensityParameters caustics;
  float causticRadius;  ///< m, the largest of their estimate
  uint causticSamples;  ///< of a pixel's samples that meet a surface straight, those that look caustics up
                        ///< for all
} CachedPathParameters;

PRELIGHT_SHARED_END

#endif
