// Receivers, the cast's parameters, and the rows of stored transport that feed the bounces.
#ifndef PRELIGHT_SHARED_CAST_TYPES_H
#define PRELIGHT_SHARED_CAST_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// A point of the surface that looks at its hemisphere.
typedef struct Receiver {
  float position[3];         ///< on the triangle, lifted off it towards the front by the rounding error
  uint triangle;
  float normal[3];           ///< unit shading normal: axis of the cosine-weighted hemisphere
  uint seed;                 ///< scrambles the low-discrepancy sequence
  float geometricNormal[3];  ///< unit, on the side of `normal` that is looked from
  uint firstSample;          ///< index of its first direction in the sequence, a multiple of raysPerReceiver
} Receiver;

typedef struct CastParameters {
  uint receiverCount;
  uint raysPerReceiver;  ///< a power of two, 8 to 256
  uint valueCount;       ///< floats a receiver that a projector writes
  uint vertexCount;      ///< of the scene; senders of back faces start here
  uint firstStored;      ///< of the rows of senders, in receivers
  float nearLimit;       ///< m; what is nearer occludes nothing
  float farLimit;        ///< m; what is farther occludes nothing; 0: no limit
  float obscurance;      ///< m; a surface at distance d lets min(d / obscurance, 1) of the light through; 0: nothing
} CastParameters;

/// A sender: the vertex (chosen by the barycentric weights) of the triangle that a ray hit, and its albedo there.
typedef struct Sender {
  uint vertex;  ///< of the scene, + vertexCount when the back was hit; PRELIGHT_NO_TRIANGLE: the ray escaped
  uint albedo;  ///< 10 bits each: red in bits 0..9, green, blue
} Sender;

PRELIGHT_SHARED_END

#endif
