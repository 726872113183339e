// What the reference renderer's kernels share with the host: camera and tables, materials, lights, paths.
#ifndef PRELIGHT_SHARED_REFERENCE_TYPES_H
#define PRELIGHT_SHARED_REFERENCE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

/// Constant over a picture, but for the first row, which changes from block to block.
typedef struct ReferenceParameters {
  uint firstPixel;  ///< of the block, row by row
  uint pathCount;  ///< of the block: pixels x samplesPerPass; path = pixel in block x samplesPerPass + sample
  uint pass;       ///< passes are independent of one another
  uint samplesPerPass;
  float eye[3];  ///< scene coordinates
  uint width;
  float right[3];  ///< from the picture's centre to its right edge, at distance 1 (orthographic: in metres)
  uint height;
  float up[3];  ///< to its upper edge
  uint perspective;
  float forward[3];  ///< unit
  uint seed;
  float zNear;
  float zFar;         ///< MAXFLOAT: infinite
  uint groupCount;    ///< of lights to choose from: punctual lights, then the emitters as one, then the sky
  uint emitterGroup;  ///< number of the groups before the emitters and the sky
  uint emitterCount;
  uint emitterTable;  ///< first entry in the tables; that of the groups starts at 0
  uint rowTable;
  uint columnTable;
  uint skyWidth;
  uint skyHeight;
  float skyTurn;       ///< of the sky counter-clockwise seen from above, in turns
  uint rouletteDepth;  ///< first vertex at which a path may end by chance
} ReferenceParameters;

#define PRELIGHT_SOLID 1u         ///< glass with an inside: refracts
#define PRELIGHT_DOUBLE_SIDED 2u  ///< emits from both sides
#define PRELIGHT_UNLIT 4u         ///< shows its base colour to the camera, is black otherwise

typedef struct ReferenceMaterial {
  float f0[3];          ///< reflectance of the dielectric's surface along its normal
  float f90;            ///< at grazing angles
  float absorption[3];  ///< inside, 1/m
  float ior;            ///< 0: infinite
  float emission[3];    ///< W/(m2 sr)
  float metallic;
  float roughness;
  float transmission;
  uint flags;  ///< PRELIGHT_SOLID | ...
  uint pad;
} ReferenceMaterial;

#define PRELIGHT_POINT_LIGHT 0u
#define PRELIGHT_DIRECTIONAL_LIGHT 1u
#define PRELIGHT_SPOT_LIGHT 2u

typedef struct ReferenceLight {
  float position[3];  ///< scene coordinates
  uint kind;
  float intensity[3];  ///< W/sr; directional: W/m2
  float inverseRange;  ///< 1/m; 0: infinite
  float direction[3];  ///< unit, the way the light travels
  float coneScale;     ///< KHR_lights_punctual: clamp(cosine x scale + offset, 0, 1) squared
  float coneOffset;
  uint pad[3];
} ReferenceLight;

#define PRELIGHT_NO_MEDIUM 0xffffffffu

typedef struct PathState {
  float throughput[3];
  float scatterDensity;  ///< 1/sr with which the ray's direction was drawn; 0: camera or mirror
  float radiance[3];     ///< gathered so far
  float relativeIor2;  ///< product of squared relative iors passed: undoes the scale of radiance in roulette
  uint medium;         ///< material that the ray runs through, or PRELIGHT_NO_MEDIUM
  uint diffuseBounces;
  uint pad[2];
} PathState;

/// Light that arrives if nothing is in the way.
typedef struct ShadowItem {
  float radiance[3];
  uint path;
} ShadowItem;

PRELIGHT_SHARED_END

#endif
