// Final gathering: rays that look for light on surfaces.
#ifndef PRELIGHT_SHARED_GATHER_TYPES_H
#define PRELIGHT_SHARED_GATHER_TYPES_H

#include "shared/compat.h"
#include "shared/scene_layout_types.h"

PRELIGHT_SHARED_BEGIN

/// 64 bytes of a buffer of arrays, as SurfaceLine.
typedef struct IrradianceLine {
  uint words[16];
} IrradianceLine;

/// An irradiance map, and where its arrays lie in IrradianceLines.
typedef struct IrradianceMapLayout {
  uint corners;  ///< float2 [face][3]
  uint texels;   ///< float4 [row][column]
  uint walls;    ///< float2 [row][column], read where there are walls
  uint patches;  ///< uint [row][column], likewise
  uint width;    ///< texels
  uint height;
  uint triangleCount;  ///< of the scene
  uint walled;         ///< 1: there are walls
} IrradianceMapLayout;

typedef struct GatherParameters {
  uint receiverCount;
  uint raysPerReceiver;
  uint seed;
  uint longWay;  ///< mirrors and glass in a row after which one more is passed by half of the rays, of twice
                 ///< the weight
  IrradianceMapLayout map;
  SceneLayout scene;
} GatherParameters;

/// A step of gathering rays to their next surface.
typedef struct GatherStep {
  uint count;  ///< rays on their way
  uint depth;  ///< surfaces before
  uint next;   ///< place of the rays and paths that go on
} GatherStep;

/// A gathering ray that has met mirrors, glass or glossy surfaces.
typedef struct GatherPath {
  float throughput[3];
  float relativeIor2;  ///< product of squared relative iors passed: undoes the scale of radiance in roulette
  uint medium;
  uint ray;              ///< that it started as, of the block
  float scatterDensity;  ///< 1/sr with which its direction was drawn, where lights were asked as well; 0:
                         ///< they were not
  uint flags;            ///< PRELIGHT_GATHER_*
  float behind;          ///< m of the ray's way before the panes that it has passed straight
} GatherPath;

#define PRELIGHT_GATHER_WIDENED 1u    ///< some lobe on the way was no narrow one, so that lamps count
#define PRELIGHT_GATHER_DISPERSED 2u  ///< it has the colour of its wavelength (transport/dispersion_funcs.cl)

/// What a gathering ray's step marks for the work queue: bits of these numbers.
#define PRELIGHT_GATHER_NEXT 0u    ///< a ray that goes on
#define PRELIGHT_GATHER_SHADOW 1u  ///< a shadow ray

/// What a shadow ray brings if nothing is in its way.
typedef struct GatherArrival {
  float radiance[3];
  uint ray;  ///< that it belongs to, of the block
} GatherArrival;

/// What the rays of a receiver tell of the irradiance around it (Ward and Heckbert 1992).
typedef struct GatherRecord {
  float irradiance[3];
  float closeness;          ///< 1/m, the mean of 1 / distance over the rays
  float nearest;            ///< m, the least distance; MAXFLOAT where nothing is seen
  float translation[3][3];  ///< [channel] its gradient along the surface, W/m3, in space
  float rotation[3][3];  ///< [channel] its gradient by rotations of the normal, W/m2 a radian, about an axis
                         ///< in space
} GatherRecord;

/// Cells of the square that a hemisphere is drawn from, a side: each has the same cosine-weighted solid
/// angle.
#define PRELIGHT_GUIDE_SIDE 8u
#define PRELIGHT_GUIDE_CELLS 64u

PRELIGHT_SHARED_END

#endif
