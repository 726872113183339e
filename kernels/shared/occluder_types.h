// Vector occluders: what receivers see of each.
#ifndef PRELIGHT_SHARED_OCCLUDER_TYPES_H
#define PRELIGHT_SHARED_OCCLUDER_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_OCCLUDER_TWO_SIDED 1u  ///< of a material: its back is a front, too
#define PRELIGHT_OCCLUDER_SHINY 2u      ///< mirrors light or is glossy
#define PRELIGHT_OCCLUDER_GLASS 4u      ///< lets light through by refraction

/// A vertex as occluders are seen by it.
typedef struct OccluderVertex {
  float normal[3];      ///< unit
  float accessibility;  ///< AO in [0,1]
} OccluderVertex;

/// What a receiver's rays met of one occluder: sums over rays, divided by the number of all its rays.
typedef struct OccluderSums {
  float formFactor;
  float direction[3];
  float offset[3];      ///< from the receiver to what was hit, m
  float distance;       ///< m
  float normal[3];      ///< of fronts, weighted by their accessibility
  float accessibility;  ///< of fronts
  float color[3];       ///< diffuse albedo
  uint group;
} OccluderSums;

/// Where the light of a ray goes on behind what it hit: mirrored, or refracted into free space.
typedef struct OccluderWay {
  float vector[3];  ///< mirrored: the normal, on the receiver's side; refracted: the direction in free space
  float share;      ///< of the ray; 0: there is no such way
  float color[3];   ///< share of the light that goes it
  uint ray;         ///< mirrored: number of the ray that finds out whether the way is open
} OccluderWay;

/// Sums of a receiver's ways, divided by the number of all its rays.
typedef struct OccluderWaySums {
  float vector[3];
  float formFactor;
  float color[3];
  float pad;
} OccluderWaySums;

// Ways of a ray and their sums lie side by side.
#define PRELIGHT_WAY_MIRRORED 0u
#define PRELIGHT_WAY_THROUGH 1u
#define PRELIGHT_WAYS 2u

/// A step of rays through glass to what is next on their way.
typedef struct GlassStep {
  uint count;   ///< rays that are followed
  uint next;    ///< place of the paths and rays that go on
  float reach;  ///< m; what meets nothing nearer is in free space
} GlassStep;

/// A ray on its way through glass.
typedef struct GlassPath {
  float throughput[3];
  uint ray;     ///< of the block's, that it began as
  uint medium;  ///< material that it runs through, or PRELIGHT_NO_MEDIUM
} GlassPath;

PRELIGHT_SHARED_END

#endif
