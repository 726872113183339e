// Camera, lights and paths, shared by the host and the kernels of the path integrators.
#ifndef PRELIGHT_SHARED_REFERENCE_TYPES_H
#define PRELIGHT_SHARED_REFERENCE_TYPES_H

#include "shared/compat.h"
#include "shared/scene_layout_types.h"

PRELIGHT_SHARED_BEGIN

/// Parameters of a picture. They are constant except for firstPixel and pathCount, which change per block.
typedef struct ReferenceParameters {
  uint firstPixel;  ///< first pixel of the block, row by row
  uint pathCount;   ///< pixels of the block x samplesPerPass; path = pixel in block x samplesPerPass + sample
  uint pass;        ///< passes are independent of one another
  uint samplesPerPass;
  float eye[3];  ///< scene coordinates
  uint width;
  float right[3];  ///< from the picture's centre to its right edge, at distance 1 (orthographic: m)
  uint height;
  float up[3];  ///< from the picture's centre to its upper edge
  uint perspective;
  float forward[3];  ///< unit
  uint seed;
  float zNear;
  float zFar;          ///< MAXFLOAT when infinite
  uint rouletteDepth;  ///< first vertex at which Russian roulette may end a path
  uint mostSegments;   ///< greatest number of a path's segments
  uint parts;          ///< index in the buffer of paths at which PathParts begin; 0: none are kept
  float lensRadius;    ///< m; read by programs with PRELIGHT_LENS
  float focus;         ///< m of depth at which a lens shows points sharply
  SceneLayout scene;
} ReferenceParameters;

/// Marks of a path's step for the work queue: bits of these numbers.
#define PRELIGHT_PATH_SHADOW 0u  ///< a shadow ray
#define PRELIGHT_PATH_NEXT 1u    ///< a ray that goes on

/// One step of paths to their next vertex. Active rays lie at the beginning of one buffer; the shadow rays
/// and continuing rays that they cause lie in further sections of it, at the same indices.
typedef struct PathStep {
  uint count;         ///< active rays
  uint depth;         ///< vertices met before
  uint next;          ///< start of the section of continuing rays
  uint shadow;        ///< start of the section of shadow rays
  uint light;         ///< a punctual or virtual light, or PRELIGHT_NO_TRIANGLE for a random one
  float leastSquare;  ///< m2; squared least distance at which a virtual light counts
  uint meets;         ///< paths to cached light: 0 if only emission counts at this vertex
  uint goesOn;        ///< paths to cached light: 0 if no ray continues
} PathStep;

/// The state of a camera path.
typedef struct PathState {
  float throughput[3];
  float
      scatterDensity;  ///< 1/sr with which the ray's direction was drawn; 0: camera or mirror; panes keep it
  float radiance[3];   ///< gathered so far
  /// Product of squared relative indices of refraction; undoes the scaling of radiance in roulette.
  float relativeIor2;
  uint medium;  ///< material in which the ray runs, or PRELIGHT_NO_MEDIUM
  uint diffuseBounces;
  float arriving[3];  ///< radiance that the current shadow ray brings if it is not occluded
  uint dispersed;     ///< 1: the path has the colour of its wavelength (transport/dispersion_funcs.cl)
  float behind;       ///< m of the ray's length before the panes that it has passed straight
  ushort panes;       ///< panes passed straight; their surfaces end no segment
  uchar seesWalls;    ///< 0: the eye looks along the ray, directly or only by mirrors and glass
  uchar pad;
} PathState;

/// Parts of a picture: PicturePart of host/images/picture_parts.h.
#define PRELIGHT_PART_EMITTED 0u
#define PRELIGHT_PART_DIRECT 1u
#define PRELIGHT_PART_INDIRECT 2u
#define PRELIGHT_PART_CAUSTIC 3u
#define PRELIGHT_PART_REFLECTED 4u
#define PRELIGHT_PARTS 5u

/// The way in which light that a path meets next comes to the eye.
#define PRELIGHT_LIT_EYE 0u      ///< directly
#define PRELIGHT_LIT_DIFFUSE 1u  ///< reflected diffusely by the first surface
/// Reflected diffusely by the first surface, after mirrors and glass only.
#define PRELIGHT_LIT_DIFFUSE_SPECULAR 2u
#define PRELIGHT_LIT_INDIRECT 3u  ///< reflected diffusely by the first surface, after other bounces
#define PRELIGHT_LIT_GLOSSY 4u    ///< reflected by a rough lobe of the first surface
#define PRELIGHT_LIT_MIRRORED \
  5u  ///< by the first surface, as a mirror, glass or a rough lobe that shows another

/// The light of a path, split into the parts of a picture; as large as PathState.
typedef struct PathParts {
  float light[PRELIGHT_PARTS][3];  ///< radiance gathered so far
  uchar way;                       ///< PRELIGHT_LIT_*
  uchar arriving;                  ///< part of the light that the current shadow ray brings
  uchar pad[2];
} PathParts;

/// A diffuse surface that a light path has met, as a point light.
typedef struct VirtualLight {
  float position[3];
  uint triangle;
  float normal[3];     ///< unit shading normal, on the side that shines
  float layerF0;       ///< layer over the diffuse body, see Bsdf::layer in transport/lobe_funcs.cl
  float intensity[3];  ///< W/sr along `geometric`, without the layer's loss on the way out
  float layerF90;
  float geometric[3];  ///< unit normal of its triangle, on the side that shines
  float layerLater;
  float through[3];  ///< W/sr against `geometric`, of a translucent surface
  float roughness;
  float coat;  ///< share of the surface that has a clear coat
  float coatRoughness;
  float sheen;  ///< largest channel of the sheen's colour
  float sheenRoughness;
  /// Gain for near places: factor 1 + nearby (1 - d^2 / r^2) at a distance d less than r, which restores the
  /// light that is lost because such places count as if at distance r.
  float nearby;
} VirtualLight;

PRELIGHT_SHARED_END

#endif
