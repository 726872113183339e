// The light that camera paths gather, split by how it was last scattered into the parts that pictures are made of
// (docs/notes/reference.md). Parts are stored behind the paths when they are requested.
#ifndef PRELIGHT_REFERENCE_PATH_PARTS_FUNCS_CL
#define PRELIGHT_REFERENCE_PATH_PARTS_FUNCS_CL

#include "core/inline.h"
#include "shared/reference_types.h"

PRELIGHT_INLINE bool keepsParts(__constant const ReferenceParameters* p) { return p->parts != 0u; }

PRELIGHT_INLINE __global PathParts* partsOf(uint first, __global PathState* paths, uint number) {
  return (__global PathParts*)(paths + first) + number;
}

PRELIGHT_INLINE void beginParts(__constant const ReferenceParameters* p, __global PathState* paths, uint number) {
  if (!keepsParts(p)) return;
  __global PathParts* parts = partsOf(p->parts, paths, number);
  for (uint i = 0; i < PRELIGHT_PARTS; ++i) vstore3((float3)(0.0f), 0, parts->light[i]);
  parts->way = PRELIGHT_LIT_EYE;
  parts->arriving = PRELIGHT_PART_DIRECT;
}

PRELIGHT_INLINE void keepPart(uint first, __global PathState* paths, uint number, uint part, float3 radiance) {
  __global float* light = partsOf(first, paths, number)->light[part];
  vstore3(vload3(0, light) + radiance, 0, light);
}

// Returns the part (PRELIGHT_PART_*) of light that a surface or the sky emits to a path. `way`: how the path came
// there, PRELIGHT_LIT_*.
PRELIGHT_INLINE uint partOfSender(uint way) {
  if (way == PRELIGHT_LIT_EYE) return PRELIGHT_PART_EMITTED;
  if (way == PRELIGHT_LIT_DIFFUSE || way == PRELIGHT_LIT_GLOSSY) return PRELIGHT_PART_DIRECT;
  if (way == PRELIGHT_LIT_MIRRORED) return PRELIGHT_PART_REFLECTED;
  return way == PRELIGHT_LIT_DIFFUSE_SPECULAR ? PRELIGHT_PART_CAUSTIC : PRELIGHT_PART_INDIRECT;
}

// Returns the part of light that arrives at the surface that a path has met: `straight` when the eye sees that surface.
PRELIGHT_INLINE uint partOfArriving(uint way, uint straight) {
  if (way == PRELIGHT_LIT_EYE) return straight;
  return way == PRELIGHT_LIT_GLOSSY || way == PRELIGHT_LIT_MIRRORED ? PRELIGHT_PART_REFLECTED : PRELIGHT_PART_INDIRECT;
}

// Returns the PRELIGHT_LIT_* of a path that was `way` before it scattered by a diffuse lobe, otherwise by a glossy
// lobe, otherwise by a mirror.
PRELIGHT_INLINE uint wayAfter(uint way, bool diffuse, bool glossy) {
  if (way == PRELIGHT_LIT_EYE) return diffuse ? PRELIGHT_LIT_DIFFUSE : glossy ? PRELIGHT_LIT_GLOSSY : PRELIGHT_LIT_MIRRORED;
  if (way == PRELIGHT_LIT_GLOSSY || way == PRELIGHT_LIT_MIRRORED) return PRELIGHT_LIT_MIRRORED;
  if (way == PRELIGHT_LIT_INDIRECT || diffuse || glossy) return PRELIGHT_LIT_INDIRECT;
  return PRELIGHT_LIT_DIFFUSE_SPECULAR;
}

// Stores in its part the light that a path has gained by meeting an emitting surface or the sky.
PRELIGHT_INLINE void keepCollected(__constant const ReferenceParameters* p, __global PathState* paths, uint number,
                                   const float* before, const PathState* path) {
  if (!keepsParts(p)) return;
  const uint part = partOfSender(partsOf(p->parts, paths, number)->way);
  keepPart(p->parts, paths, number, part, vload3(0, path->radiance) - vload3(0, before));
}

// Notes the part of the light that the path's shadow ray brings. `straight`: the part for a surface that the eye sees.
PRELIGHT_INLINE void noteArriving(__constant const ReferenceParameters* p, __global PathState* paths, uint number, uint straight) {
  if (!keepsParts(p)) return;
  __global PathParts* parts = partsOf(p->parts, paths, number);
  parts->arriving = partOfArriving(parts->way, straight);
}

// Updates the way of a path that has scattered; `before`: its state before that. Panes that it has passed straight
// change nothing, because objects behind a window count as seen directly.
PRELIGHT_INLINE void noteWay(__constant const ReferenceParameters* p, __global PathState* paths, uint number,
                             const PathState* before, const PathState* path) {
  if (!keepsParts(p) || path->panes != before->panes) return;
  __global PathParts* parts = partsOf(p->parts, paths, number);
  parts->way = wayAfter(parts->way, path->diffuseBounces > before->diffuseBounces, path->scatterDensity > 0.0f);
}

#endif
