// Rays of a cast that go on from mirrors, glass and metal, and where they end.
#ifndef PRELIGHT_SHARED_SPECULAR_TYPES_H
#define PRELIGHT_SHARED_SPECULAR_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// A step of rays to their next surface.
typedef struct SpecularStep {
  uint count;  ///< rays on their way
  uint depth;  ///< surfaces before
  uint next;   ///< place of the rays and paths that go on
} SpecularStep;

/// A ray on its way.
typedef struct SpecularPath {
  float throughput[3];
  float relativeIor2;  ///< product of squared relative iors passed: undoes the scale of radiance in roulette
  uint ray;            ///< that it started as, of the block
  uint medium;
  uint dispersed;      ///< 1: it has the colour of its wavelength (transport/dispersion_funcs.cl)
} SpecularPath;

// Of a material: how rays go on that meet it.
#define PRELIGHT_GOES_ON_SPECULARLY 1u  ///< as from glass, mirrors and metal
#define PRELIGHT_GOES_ON_WITHIN 2u      ///< scattered inside

#define PRELIGHT_SPECULAR_MET_NONE 0u  ///< the ray's own hit counts
#define PRELIGHT_SPECULAR_ABSORBED 1u
#define PRELIGHT_SPECULAR_SKY 2u
#define PRELIGHT_SPECULAR_SURFACE 3u   ///< a diffuse one; its albedo is not in the throughput
#define PRELIGHT_SPECULAR_BODY 4u      ///< the diffuse part of one that reflects otherwise, too; in the throughput
#define PRELIGHT_SPECULAR_THROUGH 5u   ///< the same, of light that comes through it from its other side

/// Where a ray's way ends.
typedef struct SpecularEnd {
  float throughput[3];  ///< share of the radiance there that arrives at the receiver
  uint kind;            ///< PRELIGHT_SPECULAR_*
  float direction[3];   ///< in which the way ends
  uint triangle;        ///< of surfaces
  float u, v;           ///< of surfaces, as in Hit
} SpecularEnd;

PRELIGHT_SHARED_END

#endif
