// Photons as they are stored where they land.
#ifndef PRELIGHT_SHARED_PHOTON_TYPES_H
#define PRELIGHT_SHARED_PHOTON_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// The side of the surface that it landed on follows from `direction` and the triangle's normal.
typedef struct Photon {
  float position[3];  ///< scene coordinates
  uint triangle;      ///< it landed on
  float power[3];     ///< W
  uint direction;     ///< it came from, unit, away from the surface; octahedral, 16 bits a coordinate
} Photon;

PRELIGHT_SHARED_END

#endif
