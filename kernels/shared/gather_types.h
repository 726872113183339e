// Final gathering: rays that look for light on surfaces.
#ifndef PRELIGHT_SHARED_GATHER_TYPES_H
#define PRELIGHT_SHARED_GATHER_TYPES_H

#include "shared/compat.h"
#include "shared/scene_layout_types.h"

PRELIGHT_SHARED_BEGIN

/// 64 bytes of a buffer of arrays, like SurfaceLine.
typedef struct IrradianceLine {
  uint words[16];
} IrradianceLine;

/// An irradiance map: its size, and the places of its arrays in IrradianceLines.
typedef struct IrradianceMapLayout {
  uint corners;  ///< float2 [face][3]
  uint texels;   ///< float4 [row][column]
  uint walls;    ///< float2 [row][column], read only if `walled`
  uint patches;  ///< uint [row][column], read only if `walled`
  uint width;    ///< texels
  uint height;
  uint triangleCount;  ///< triangles of the scene
  uint walled;         ///< 1: there are walls
} IrradianceMapLayout;

/// Parameters of final gathering.
typedef struct GatherParameters {
  uint receiverCount;
  uint raysPerReceiver;
  uint seed;
  /// Mirrors and glass in a row after which half of the rays are ended at each further one, and the others
  /// get twice the weight.
  uint longWay;
  IrradianceMapLayout map;
  SceneLayout scene;
} GatherParameters;

/// One step of gathering rays to their next surface.
typedef struct GatherStep {
  uint count;  ///< active rays
  uint depth;  ///< surfaces met before
  uint next;   ///< index of the first ray and path that go on
} GatherStep;

/// The state of a gathering ray that has met mirrors, glass or glossy surfaces.
typedef struct GatherPath {
  float throughput[3];
  /// Product of squared relative indices of refraction; undoes the scaling of radiance in roulette.
  float relativeIor2;
  uint medium;
  uint ray;  ///< index in the block of the ray that it started as
  /// 1/sr; density with which its direction was drawn where lights were sampled as well; 0: they were not.
  float scatterDensity;
  uint flags;    ///< PRELIGHT_GATHER_*
  float behind;  ///< m of the ray's length before the panes that it has passed straight
} GatherPath;

#define PRELIGHT_GATHER_WIDENED 1u  ///< some lobe of the path was not narrow, so lamps count
/// The path has the colour of its wavelength (transport/dispersion_funcs.cl).
#define PRELIGHT_GATHER_DISPERSED 2u

/// Marks of a gathering ray's step for the work queue: bits of these numbers.
#define PRELIGHT_GATHER_NEXT 0u    ///< a ray that goes on
#define PRELIGHT_GATHER_SHADOW 1u  ///< a shadow ray

/// The light that a shadow ray brings if it is not occluded.
typedef struct GatherArrival {
  float radiance[3];
  uint ray;  ///< index in the block of the ray that it belongs to
} GatherArrival;

/// Irradiance at a receiver and its gradients (Ward and Heckbert 1992).
typedef struct GatherRecord {
  float irradiance[3];
  float closeness;          ///< 1/m, the mean of 1 / distance over the rays
  float nearest;            ///< m, the least distance; MAXFLOAT where no surface is seen
  float translation[3][3];  ///< [channel] gradient along the surface, W/m3, world space
  /// [channel] gradient by rotations of the normal, W/m2 per radian, about a world-space axis.
  float rotation[3][3];
} GatherRecord;

/// Cells per side of the square from which a hemisphere is drawn. All cells have the same cosine-weighted
/// solid angle.
#define PRELIGHT_GUIDE_SIDE 8u
#define PRELIGHT_GUIDE_CELLS 64u

PRELIGHT_SHARED_END

#endif
