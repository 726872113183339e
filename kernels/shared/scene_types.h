// Scene data that kernels read in addition to the BVH.
#ifndef PRELIGHT_SHARED_SCENE_TYPES_H
#define PRELIGHT_SHARED_SCENE_TYPES_H

#include "shared/compat.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_WRAP_REPEAT 0u
#define PRELIGHT_WRAP_CLAMP 1u
#define PRELIGHT_WRAP_MIRROR 2u

#define PRELIGHT_NO_TEXTURE 0xffffffffu

#define PRELIGHT_NEAREST 1u     ///< texels are not interpolated
#define PRELIGHT_SECOND_SET 2u  ///< the texture uses the second set of texture coordinates

/// A texture: an image with the mapping of its coordinates.
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

#define PRELIGHT_BLENDED 1u  ///< alpha is the surface's coverage
#define PRELIGHT_PANE 2u     ///< thin glass that may let light straight through

/// The part of a material that tracing and bounces read at a hit. Textures are indices in their list;
/// PRELIGHT_NO_TEXTURE: none.
typedef struct DeviceMaterial {
  float albedo[3];    ///< linear; multiplies texture and vertex colour
  float alphaCutoff;  ///< below 0: opaque; otherwise holes are where alpha is below it
  float alphaFactor;
  uint colorTexture;
  float metallic;  ///< share without albedo, times B of its texture; without a texture `albedo` contains it
  uint metallicTexture;
  float glass;  ///< share without albedo, times R of its texture; without a texture `albedo` contains it
  uint glassTexture;
  uint transmission;  ///< diffuse, 10 bits each: red in bits 0..9, green, blue
  uint flags;         ///< PRELIGHT_BLENDED | PRELIGHT_PANE
} DeviceMaterial;

/// Vertices and material of a triangle.
typedef struct DeviceTriangle {
  uint vertex[3];
  uint material;
} DeviceTriangle;

/// Triangles with consecutive indices, up to the first of the next range. Instances of one shape are ranges
/// whose triangles and vertices are stored once. Shifts are added and wrap around.
typedef struct SurfaceRange {
  uint firstTriangle;  ///< first of the scene's triangles
  uint triangleShift;  ///< from triangles of the scene to stored ones
  uint vertexShift;    ///< from stored vertices to those of the scene
  uint pad;
} SurfaceRange;

PRELIGHT_SHARED_END

#endif
