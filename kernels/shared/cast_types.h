// Receivers, the cast's parameters, and the rows of stored transport that feed the bounces.
#ifndef PRELIGHT_SHARED_CAST_TYPES_H
#define PRELIGHT_SHARED_CAST_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// A point of the surface from which rays are cast over its hemisphere.
typedef struct Receiver {
  float position[3];  ///< on the triangle, lifted off it towards the front by the rounding error
  uint triangle;
  float normal[3];           ///< unit shading normal: axis of the cosine-weighted hemisphere
  uint seed;                 ///< scrambles the low-discrepancy sequence
  float geometricNormal[3];  ///< unit, on the side from which rays are cast
  uint firstSample;          ///< index of its first direction in the sequence, a multiple of raysPerReceiver
} Receiver;

/// Parameters of a block's casting.
typedef struct CastParameters {
  uint receiverCount;
  uint raysPerReceiver;  ///< a power of two, 8 to 256
  uint valueCount;       ///< floats that a projector writes per receiver
  uint vertexCount;      ///< vertices of the scene; vertices of backs are numbered from here on
  uint firstStored;      ///< row of senders, in receivers, at which the block is stored
  float nearLimit;       ///< m; nearer surfaces do not occlude
  float farLimit;        ///< m; farther surfaces do not occlude; 0: no limit
  /// M; a surface at distance d lets min(d / obscurance, 1) of the light through; 0: none.
  float obscurance;
} CastParameters;

/// Emitter of bounced light for one ray: a vertex of the triangle that the ray hit, chosen by the barycentric
/// weights, and the albedo at the hit.
typedef struct Sender {
  uint vertex;  ///< index, + vertexCount when the back was hit; PRELIGHT_NO_TRIANGLE: the ray escaped
  uint albedo;  ///< 10 bits each: red in bits 0..9, green, blue; bits 30 and 31: how often they are doubled
} Sender;

PRELIGHT_SHARED_END

#endif
