// What the reference renderer's kernels share with the host: camera, lights and paths.
#ifndef PRELIGHT_SHARED_REFERENCE_TYPES_H
#define PRELIGHT_SHARED_REFERENCE_TYPES_H

#include "shared/compat.h"
#include "shared/scene_layout_types.h"

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
  float zFar;          ///< MAXFLOAT: infinite
  uint rouletteDepth;  ///< first vertex at which a path may end by chance
  uint mostSegments;   ///< of a path
  uint parts;          ///< first of the buffer of paths that holds PathParts; 0: none are kept
  SceneLayout scene;
} ReferenceParameters;

/// What a path's step marks for the work queue: bits of these numbers.
#define PRELIGHT_PATH_SHADOW 0u  ///< a shadow ray
#define PRELIGHT_PATH_NEXT 1u    ///< a ray that goes on

/// A step of paths by a vertex. Rays that are followed lie at the beginning of one buffer; what they send,
/// shadow rays and rays that go on, in parts of it, in the same places.
typedef struct PathStep {
  uint count;         ///< rays that are followed
  uint depth;         ///< vertices before
  uint next;          ///< part of the rays that go on
  uint shadow;        ///< of shadow rays
  uint light;         ///< a punctual or virtual one, or PRELIGHT_NO_TRIANGLE: by chance
  float leastSquare;  ///< m2; a virtual light nearer than its root counts as at that distance
  uint meets;         ///< of paths to cached light: 0: emission alone counts at this vertex
  uint goesOn;        ///< of those: 0: no ray leaves it
} PathStep;

typedef struct PathState {
  float throughput[3];
  float
      scatterDensity;  ///< 1/sr with which the ray's direction was drawn; 0: camera or mirror; panes keep it
  float radiance[3];   ///< gathered so far
  float relativeIor2;  ///< product of squared relative iors passed: undoes the scale of radiance in roulette
  uint medium;         ///< material that the ray runs through, or PRELIGHT_NO_MEDIUM
  uint diffuseBounces;
  float arriving[3];  ///< radiance that the shadow ray at hand brings if nothing is in its way
  uint dispersed;     ///< 1: it has the colour of its wavelength (transport/dispersion_funcs.cl)
  float behind;       ///< m of the ray's way before the panes that it has passed straight
  ushort panes;       ///< that the path has passed straight: their surfaces end no segment
  uchar seesWalls;    ///< 0: the eye looks along the ray, straight or by mirrors and glass alone
  uchar pad;
} PathState;

/// Parts of a picture: PicturePart of host/images/picture_parts.h.
#define PRELIGHT_PART_EMITTED 0u
#define PRELIGHT_PART_DIRECT 1u
#define PRELIGHT_PART_INDIRECT 2u
#define PRELIGHT_PART_CAUSTIC 3u
#define PRELIGHT_PART_REFLECTED 4u
#define PRELIGHT_PARTS 5u

/// How light that a path meets next would come to the eye.
#define PRELIGHT_LIT_EYE 0u               ///< straight
#define PRELIGHT_LIT_DIFFUSE 1u           ///< off the first surface, diffusely
#define PRELIGHT_LIT_DIFFUSE_SPECULAR 2u  ///< the same, by mirrors and glass before
#define PRELIGHT_LIT_INDIRECT 3u          ///< the same, by other ways before
#define PRELIGHT_LIT_GLOSSY 4u            ///< off the first surface's rough lobe
#define PRELIGHT_LIT_MIRRORED \
  5u  ///< by the first surface, as a mirror, glass or a rough lobe that shows another

/// The light of a path by parts; as large as PathState.
typedef struct PathParts {
  float light[PRELIGHT_PARTS][3];  ///< radiance gathered so far
  uchar way;                       ///< PRELIGHT_LIT_*
  uchar arriving;                  ///< part that the shadow ray at hand brings
  uchar pad[2];
} PathParts;

/// A diffuse surface that a light path has met, as a point light.
typedef struct VirtualLight {
  float position[3];
  uint triangle;
  float normal[3];     ///< for shading; unit, on the side that shines
  float layerF0;       ///< of the layer over the body, see Bsdf::layer in transport/lobe_funcs.cl
  float intensity[3];  ///< W/sr along `geometric`, without the layer's loss on the way out
  float layerF90;
  float geometric[3];  ///< unit, of its triangle, on the side that shines
  float layerLater;
  float through[3];  ///< W/sr the other way, of a translucent surface
  float roughness;
  float coat;  ///< share of the surface that has a clear coat
  float coatRoughness;
  float sheen;  ///< its colour's largest channel
  float sheenRoughness;
  float nearby;  ///< of what it sends near places: factor 1 + nearby (1 - d^2 / r^2) at a distance d less
                 ///< than r, which gives back what is lost as they count as at the distance r
} VirtualLight;

PRELIGHT_SHARED_END

#endif
