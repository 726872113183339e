// Photons on their way: their sources, their state, and the outcomes of their hits.
#ifndef PRELIGHT_SHARED_PHOTON_PATH_TYPES_H
#define PRELIGHT_SHARED_PHOTON_PATH_TYPES_H

#include "shared/compat.h"
#include "shared/scene_layout_types.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_SOURCE_PUNCTUAL 0u
#define PRELIGHT_SOURCE_EMITTERS 1u
#define PRELIGHT_SOURCE_SKY 2u
#define PRELIGHT_SOURCE_EYE 3u  ///< not a light but a picture's eye, which sends importons

#define PRELIGHT_ALL_EMITTERS 0xffffffffu

/// One or several lights from which photons start. Its photons are numbered: photon i is always the same.
typedef struct PhotonSource {
  uint kind;   ///< PRELIGHT_SOURCE_*
  uint light;  ///< punctual light, or the first emitter; PRELIGHT_ALL_EMITTERS: any, chosen by power
  /// Number of emitters of one triangle, from the first one on, from which one is chosen by power.
  uint emitters;
  uint count;  ///< photons that share its power
  uint seed;
  /// First cell, in the list of cells, of the directions (for the sky: of the places) of its photons.
  uint firstCell;
  uint cellCount;    ///< 0: in all directions
  uint cellsASide;   ///< columns, and rows, of the square of directions
  float tangent[3];  ///< with cells: unit, perpendicular to the axis of the directions, where azimuth 0 is
} PhotonSource;

/// A cell of a source's square. All entries of a list of cells get the same number of photons; a cell that
/// needs more has several entries.
typedef struct SourceCell {
  uint cell;    ///< row * cellsASide + column
  uint copies;  ///< entries of this cell, which share its power
  uint copy;    ///< number of this entry among them
} SourceCell;

/// The camera of a picture, which sends importons uniformly over the picture.
typedef struct Eye {
  float position[3];  ///< scene coordinates
  uint perspective;
  float right[3];  ///< from the picture's centre to its right edge, at distance 1 (orthographic: m)
  float zNear;     ///< m; nearer surfaces are not seen
  float up[3];     ///< from the picture's centre to its upper edge
  uint pad0;
  float forward[3];  ///< unit
  uint pad1;
} Eye;

/// Parameters of a block of photons.
typedef struct PhotonParameters {
  uint firstPhoton;  ///< first photon of the block, in the source or in the list of selected photons
  uint chosen;       ///< 1: only photons of a list are sent
  uint pathCount;    ///< paths of the block
  uint rouletteDepth;
  float unit;       ///< W per count of the tallies
  float centre[3];  ///< scene coordinates; centre of what a disc of `radius` covers for distant light
  float radius;
  float distance;  ///< m; distance from the centre at which distant light starts
  PhotonSource source;
  SceneLayout scene;
  Eye eye;  ///< for PRELIGHT_SOURCE_EYE
} PhotonParameters;

/// A grid of cubes with one number each, [z][y][x].
typedef struct ImportanceGrid {
  float lower[3];  ///< corner, scene coordinates
  float cellsPerMetre;
  uint side;  ///< cells per axis
} ImportanceGrid;

/// One step of photons to their next surface.
typedef struct PhotonStep {
  uint count;  ///< active photons
  uint depth;  ///< surfaces met before
  uint next;   ///< index of the first ray of photons that go on; those of active photons start at 0
} PhotonStep;

// Flags of how a photon has been scattered so far.
#define PRELIGHT_SCATTERED_SPECULAR 1u  ///< by a mirror, by glass, or by a narrow lobe
#define PRELIGHT_SCATTERED_WIDELY 2u    ///< diffusely or by a rough lobe

/// The state of a photon on its way.
typedef struct PhotonPath {
  float power[3];  ///< W
  uint medium;     ///< material in which it runs, or PRELIGHT_NO_MEDIUM
  uint scattered;  ///< PRELIGHT_SCATTERED_* | ...
  uint photon;     ///< number in its source
  uint mirrored;   ///< number of scatterings in a row by mirrors, glass and narrow lobes
  uint dispersed;  ///< 1: the photon has the colour of its wavelength (transport/dispersion_funcs.cl)
} PhotonPath;

// Outcomes of a photon's hit on a surface: marks of a WorkQueue, bits 0, 1 and 2.
#define PRELIGHT_PHOTON_GOES_ON 1u
#define PRELIGHT_PHOTON_STORED 2u
#define PRELIGHT_PHOTON_MET_BACK 4u  ///< the back of a one-sided surface that reflects diffusely

PRELIGHT_SHARED_END

#endif
