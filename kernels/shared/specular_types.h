// Rays of a cast that go on from mirrors, glass and metal, and where they end.
#ifndef PRELIGHT_SHARED_SPECULAR_TYPES_H
#define PRELIGHT_SHARED_SPECULAR_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// One step of rays to their next surface.
typedef struct SpecularStep {
  uint count;  ///< active rays
  uint depth;  ///< surfaces met before
  uint next;   ///< index of the first ray and path that go on
} SpecularStep;

/// A ray that is followed from surface to surface.
typedef struct SpecularPath {
  float throughput[3];
  /// Product of squared relative indices of refraction; undoes the scaling of radiance in roulette.
  float relativeIor2;
  uint ray;  ///< index in the block of the ray that it started as
  uint medium;
  uint dispersed;  ///< 1: the path has the colour of its wavelength (transport/dispersion_funcs.cl)
} SpecularPath;

// Flags of a material: how rays that meet it go on.
#define PRELIGHT_GOES_ON_SPECULARLY 1u  ///< by glass, mirrors and metal
#define PRELIGHT_GOES_ON_WITHIN 2u      ///< by scattering inside

#define PRELIGHT_SPECULAR_MET_NONE 0u  ///< the ray met no such surface, and its own hit counts
#define PRELIGHT_SPECULAR_ABSORBED 1u
#define PRELIGHT_SPECULAR_SKY 2u
#define PRELIGHT_SPECULAR_SURFACE 3u  ///< a diffuse surface; its albedo is not in the throughput
/// The diffuse part of a surface with other lobes; its albedo is in the throughput.
#define PRELIGHT_SPECULAR_BODY 4u
#define PRELIGHT_SPECULAR_THROUGH 5u  ///< as BODY, for light that comes through from the other side

/// The end of a followed ray.
typedef struct SpecularEnd {
  float throughput[3];  ///< share of the radiance there that arrives at the receiver
  uint kind;            ///< PRELIGHT_SPECULAR_*
  float direction[3];   ///< direction in which the last ray travelled
  uint triangle;        ///< for surfaces: the triangle
  float u, v;           ///< for surfaces: as in Hit
} SpecularEnd;

PRELIGHT_SHARED_END

#endif
