// Emission of photons from lights.
// Options: those of the included files.
#include "photon/path_funcs.cl"
#include "transport/emission_funcs.cl"
#include "transport/scene_funcs.cl"

// Returns a photon's point in the square of directions. Without cells it is a point of the plain sequence, so that
// photons whose numbers agree modulo a power of two have similar directions; otherwise the photons take turns over the
// cells, each with its own sequence.
uint2 directionBits(PhotonSource s, SourceCell c, uint photon) {
  if (s.cellCount == 0u) return sampleSobolBits(photon, s.seed);
  const uint2 within = sampleSobolBits(photon / s.cellCount * c.copies + c.copy, s.seed ^ hashInteger(c.cell));
  const uint2 corner = (uint2)(c.cell % s.cellsASide, c.cell / s.cellsASide) * (uint)(0x100000000ul / s.cellsASide);
  return corner + within / s.cellsASide;  // cellsASide is a power of two
}

// One work-item per photon: consecutive photons or, of a selection, those that `numbers` lists from firstPhoton on.
// cells [source.firstCell + cell] -> paths, queue, rays [pathCount]; emitted [pathCount][3], in counts of the tallies.
// Next: trace, scatterPhotons.
__kernel void emitPhotons(__constant const PhotonParameters* p, __global const SurfaceLine* surfaceLines,
                          __global const ShadingLine* shadingLines, __global const LightLine* lightLines,
                          __global const SourceCell* cells, __global const uint* numbers, __global PhotonPath* paths,
                          __global uint* queue, __global Ray* rays, __global long* emitted) {
  const size_t i = get_global_id(0);
  if (i >= p->pathCount) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const uint rank = p->firstPhoton + (uint)i;
  const uint photon = p->chosen != 0u ? numbers[rank] : rank;
  const PhotonSource source = p->source;
  SourceCell cell = {0u, 1u, 0u};
  if (source.cellCount != 0u) cell = cells[source.firstCell + photon % source.cellCount];
  const EmissionPoint point = {directionBits(source, cell, photon), photonBits(p, photon, PRELIGHT_PAIR_PLACE),
                               photonBits(p, photon, PRELIGHT_PAIR_EMITTER)};
  const Emission e = emitLight(p, scene.lights, scene.surface, point);
  float share = 1.0f / (float)source.count;
  if (source.cellCount != 0u)
    share *= (float)source.cellCount / ((float)source.cellsASide * (float)source.cellsASide * (float)cell.copies);
  PhotonPath path;
  vstore3(e.power * share, 0, path.power);
  path.medium = PRELIGHT_NO_MEDIUM;
  path.scattered = 0u;
  path.photon = photon;
  path.mirrored = 0u;
  path.dispersed = 0u;
  paths[i] = path;
  queue[i] = (uint)i;
  Ray ray;
  vstore3(e.origin, 0, ray.origin);
  vstore3(e.direction, 0, ray.direction);
  ray.sourceTriangle = e.triangle;
  ray.tMax = MAXFLOAT;
  rays[i] = ray;
  for (uint c = 0; c < 3; ++c) emitted[3 * i + c] = countsOf(p, path.power[c]);
}
