// Photons as they are stored where they land.
#ifndef PRELIGHT_SHARED_PHOTON_TYPES_H
#define PRELIGHT_SHARED_PHOTON_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// A stored photon. The side of the surface on which it landed follows from `direction` and the triangle's
/// normal.
typedef struct Photon {
  float position[3];  ///< scene coordinates
  uint triangle;      ///< triangle on which it landed
  float power[3];     ///< W
  /// Unit direction from which it came, away from the surface; octahedral, 16 bits per coordinate.
  uint direction;
} Photon;

PRELIGHT_SHARED_END

#endif
