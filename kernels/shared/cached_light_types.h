// Parameters of camera paths that end where they meet precomputed light.
#ifndef PRELIGHT_SHARED_CACHED_LIGHT_TYPES_H
#define PRELIGHT_SHARED_CACHED_LIGHT_TYPES_H

#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/reference_types.h"

PRELIGHT_SHARED_BEGIN

/// Parameters of integrate/cached_path_kernels.cl.
typedef struct CachedPathParameters {
  ReferenceParameters paths;
  IrradianceMapLayout indirect;
  DensityParameters caustics;
  float causticRadius;  ///< m; largest radius of the caustics' estimate
  uint causticSamples;  ///< samples of a pixel that see a surface directly and look caustics up for all
} CachedPathParameters;

PRELIGHT_SHARED_END

#endif
