// Photons on their way: where they start, what they carry, what has become of them.
#ifndef PRELIGHT_SHARED_PHOTON_PATH_TYPES_H
#define PRELIGHT_SHARED_PHOTON_PATH_TYPES_H

#include "shared/compat.h"
#include "shared/scene_layout_types.h"

PRELIGHT_SHARED_BEGIN

#define PRELIGHT_SOURCE_PUNCTUAL 0u
#define PRELIGHT_SOURCE_EMITTERS 1u
#define PRELIGHT_SOURCE_SKY 2u
#define PRELIGHT_SOURCE_EYE 3u  ///< no light, but a picture's eye, which sends importons

#define PRELIGHT_ALL_EMITTERS 0xffffffffu

/// A light, or several, that photons start from. Its photons are enumerated: photon i is always the same.
typedef struct PhotonSource {
  uint kind;      ///< PRELIGHT_SOURCE_*
  uint light;     ///< punctual light, or the first emitter; PRELIGHT_ALL_EMITTERS: any, chosen by power
  uint emitters;  ///< of one triangle that are chosen of by power, from the first one on
  uint count;     ///< photons that share its power
  uint seed;
  uint firstCell;    ///< of the directions that it sends photons in (of the sky: of places), into the list of
                     ///< cells
  uint cellCount;    ///< 0: in all directions
  uint cellsASide;   ///< the square of directions is cut into as many columns and rows
  float tangent[3];  ///< with cells: unit, across the axis that directions are around, where a turn starts
} PhotonSource;

/// A cell of a source's square. Each entry of a list of them gets as many photons; a cell that needs more has
/// several.
typedef struct SourceCell {
  uint cell;    ///< row * cellsASide + column
  uint copies;  ///< entries of this cell, which share its power
  uint copy;    ///< of these
} SourceCell;

/// What a picture is seen from. Importons leave it evenly over the picture.
typedef struct Eye {
  float position[3];  ///< scene coordinates
  uint perspective;
  float right[3];  ///< from the picture's centre to its right edge, at distance 1 (orthographic: in metres)
  float zNear;     ///< nearer than that nothing is seen
  float up[3];     ///< to its upper edge
  uint pad0;
  float forward[3];  ///< unit
  uint pad1;
} Eye;

typedef struct PhotonParameters {
  uint firstPhoton;  ///< of the block, in the source, or in the list of those that were chosen
  uint chosen;       ///< 1: photons of a list alone
  uint pathCount;    ///< of the block
  uint rouletteDepth;
  float unit;       ///< W a count of the tallies
  float centre[3];  ///< scene coordinates: light from afar covers the disc of this radius around it
  float radius;
  float distance;  ///< from the centre, at which light from afar starts
  PhotonSource source;
  SceneLayout scene;
  Eye eye;  ///< of PRELIGHT_SOURCE_EYE
} PhotonParameters;

/// Cubes of space with a number each, [z][y][x].
typedef struct ImportanceGrid {
  float lower[3];  ///< corner, scene coordinates
  float cellsPerMetre;
  uint side;  ///< cells
} ImportanceGrid;

/// A step of photons to their next surface.
typedef struct PhotonStep {
  uint count;  ///< photons on their way
  uint depth;  ///< surfaces before
  uint next;   ///< place of the rays of those that go on; those that are followed start at 0
} PhotonStep;

// How a photon has been scattered so far.
#define PRELIGHT_SCATTERED_SPECULAR 1u  ///< by a mirror, glass, or a lobe that is nearly one
#define PRELIGHT_SCATTERED_WIDELY 2u    ///< diffusely or by a rough lobe

typedef struct PhotonPath {
  float power[3];  ///< W
  uint medium;     ///< material that it runs through, or PRELIGHT_NO_MEDIUM
  uint scattered;  ///< PRELIGHT_SCATTERED_* | ...
  uint photon;     ///< of its source
  uint mirrored;   ///< times in a row that mirrors, glass and narrow lobes have scattered it
  uint dispersed;  ///< 1: it has the colour of its wavelength (transport/dispersion_funcs.cl)
} PhotonPath;

// What became of a photon at a surface.
// Marks of a WorkQueue: bits 0, 1 and 2.
#define PRELIGHT_PHOTON_GOES_ON 1u
#define PRELIGHT_PHOTON_STORED 2u
#define PRELIGHT_PHOTON_MET_BACK 4u  ///< of a one-sided surface that reflects diffusely

PRELIGHT_SHARED_END

#endif
