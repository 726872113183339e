// Vector occluders: sums over what receivers see of each occluder.
#ifndef PRELIGHT_SHARED_OCCLUDER_TYPES_H
#define PRELIGHT_SHARED_OCCLUDER_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_OCCLUDER_TWO_SIDED 1u  ///< a material whose back is a front as well
#define PRELIGHT_OCCLUDER_SHINY 2u      ///< mirrors light or is glossy
#define PRELIGHT_OCCLUDER_GLASS 4u      ///< lets light through by refraction

/// A vertex of an occluder, as receivers see it.
typedef struct OccluderVertex {
  float normal[3];      ///< unit
  float accessibility;  ///< AO in [0,1]
} OccluderVertex;

/// Sums over a receiver's rays that met one occluder, divided by the number of all its rays.
typedef struct OccluderSums {
  float formFactor;
  float direction[3];
  float offset[3];      ///< from the receiver to the hits, m
  float distance;       ///< m
  float normal[3];      ///< normals of fronts, weighted by their accessibility
  float accessibility;  ///< accessibility of fronts
  float color[3];       ///< diffuse albedo
  uint group;
} OccluderSums;

/// A direction from which light comes to the surface that a ray hit: by mirroring, or by refraction from free
/// space.
typedef struct OccluderWay {
  float vector[3];  ///< mirrored: the normal, on the receiver's side; refracted: the direction in free space
  float share;      ///< share of the ray; 0: there is no such direction
  float color[3];   ///< share of the light that arrives this way
  uint ray;         ///< mirrored: index of the ray that tests whether the direction is open
} OccluderWay;

/// Sums of a receiver's OccluderWays, divided by the number of all its rays.
typedef struct OccluderWaySums {
  float vector[3];
  float formFactor;
  float color[3];
  float pad;
} OccluderWaySums;

// Index of a way among the PRELIGHT_WAYS of a ray or of sums.
#define PRELIGHT_WAY_MIRRORED 0u
#define PRELIGHT_WAY_THROUGH 1u
#define PRELIGHT_WAYS 2u

/// One step of rays through glass to their next hit.
typedef struct GlassStep {
  uint count;   ///< active rays
  uint next;    ///< index of the first path and ray that go on
  float reach;  ///< m; a ray that meets nothing nearer is in free space
} GlassStep;

/// A ray that is followed through glass.
typedef struct GlassPath {
  float throughput[3];
  uint ray;     ///< index in the block of the ray that it began as
  uint medium;  ///< material in which it runs, or PRELIGHT_NO_MEDIUM
} GlassPath;

PRELIGHT_SHARED_END

#endif
