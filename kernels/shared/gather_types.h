// Final gathering: rays that look for light on surfaces.
#ifndef PRELIGHT_SHARED_GATHER_TYPES_H
#define PRELIGHT_SHARED_GATHER_TYPES_H

#include "shared/compat.h"
#include "shared/shade_types.h"

PRELIGHT_SHARED_BEGIN

typedef struct GatherParameters {
  uint receiverCount;
  uint raysPerReceiver;
  uint seed;
  uint mapWidth;  ///< of the irradiance map, texels
  uint mapHeight;
  uint triangleCount;  ///< of the scene
  uint longWay;  ///< mirrors and glass in a row after which one more is passed by half of the rays, of twice the weight
  LightLayout lights;
} GatherParameters;

/// A gathering ray that has met mirrors, glass or glossy surfaces.
typedef struct GatherPath {
  float throughput[3];
  float relativeIor2;  ///< product of squared relative iors passed: undoes the scale of radiance in roulette
  uint medium;
  uint ray;      ///< that it started as, of the block
  uint widened;  ///< 1: some lobe on the way was no narrow one, so that lamps count
} GatherPath;

PRELIGHT_SHARED_END

#endif
