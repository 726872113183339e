// Scene data that kernels read besides the BVH.
#ifndef PRELIGHT_SHARED_SCENE_TYPES_H
#define PRELIGHT_SHARED_SCENE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_WRAP_REPEAT 0u
#define PRELIGHT_WRAP_CLAMP 1u
#define PRELIGHT_WRAP_MIRROR 2u

#define PRELIGHT_NO_TEXTURE 0xffffffffu

#define PRELIGHT_NEAREST 1u     ///< texels are not interpolated
#define PRELIGHT_SECOND_SET 2u  ///< of texture coordinates

/// Use of an image.
typedef struct DeviceTexture {
  float u[3];        ///< times texture coordinates (u, v, 1): u of the image, [0,1) from left to right
  uint texelOffset;  ///< first texel in the texel buffer (ushort4, linear RGBA in 1/65535)
  float v[3];        ///< v of the image, downwards
  uint flags;        ///< PRELIGHT_NEAREST | ...
  uint width;
  uint height;
  uint wrapS;  ///< PRELIGHT_WRAP_*
  uint wrapT;
} DeviceTexture;

#define PRELIGHT_BLENDED 1u  ///< alpha is the share of the surface that is there
#define PRELIGHT_PANE 2u     ///< thin glass that may let light straight through

/// What a hit finds at once. Textures are places in the list of them; PRELIGHT_NO_TEXTURE: none.
typedef struct DeviceMaterial {
  float albedo[3];    ///< linear; multiplies texture and vertex colour
  float alphaCutoff;  ///< < 0: opaque; holes are where alpha is below
  float alphaFactor;
  uint colorTexture;
  float metallic;  ///< times B of its texture: share that has no albedo; without a texture `albedo` has it
  uint metallicTexture;
  float glass;  ///< the same with R
  uint glassTexture;
  uint transmission;  ///< diffuse, 10 bits each: red in bits 0..9, green, blue
  uint flags;         ///< PRELIGHT_BLENDED | PRELIGHT_PANE
} DeviceMaterial;

typedef struct DeviceTriangle {
  uint vertex[3];
  uint material;
} DeviceTriangle;

/// Triangles that follow one another, up to the first of the next range. Drawings of one shape are ranges
/// whose triangles and vertices are stored once. Shifts are added, and wrap around.
typedef struct SurfaceRange {
  uint firstTriangle;  ///< of the scene's
  uint triangleShift;  ///< from the scene's triangles to those stored
  uint vertexShift;    ///< from stored vertices to the scene's
  uint pad;
} SurfaceRange;

PRELIGHT_SHARED_END

#endif
