// Walks of camera paths within bodies that scatter light, between trace and collectRadiance of
// integrate/path_kernels.cl:
//   beginWalks -> [stepWalks of transport/walk_kernels.cl -> trace] ... -> endWalks
// Options: those of the included files.
#include "integrate/path_funcs.cl"
#include "transport/scene_funcs.cl"
#include "transport/walk_funcs.cl"

// One work-item per traced ray. numbers: the path of each ray -> walks [count], and marks where a walk begins.
__kernel void beginWalks(__constant const ReferenceParameters* p, const PathStep step, __global const SurfaceLine* surfaceLines,
                         __global const ShadingLine* shadingLines, __global const Ray* rays, __global const Hit* hits,
                         __global const uint* numbers, __global const PathState* paths, __global MediumWalk* walks,
                         __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const PathScene s = shadedSurfaceOf(&p->scene, surfaceLines, shadingLines);
  const uint number = numbers[i];
  const PathState path = paths[number];
  uint medium = path.medium;
  if (hits[i].triangle != PRELIGHT_NO_TRIANGLE) medium = mediumBefore(loadInteraction(s, rays[i], hits[i]), medium);
  const bool within = scattersWithin(s, medium);
  const uint seed = hashInteger(pathBits(p, number, step.depth * PRELIGHT_PAIRS_A_VERTEX + PRELIGHT_PAIR_LIGHT).x ^ 0x2545f491u);
  walks[i] = within ? beginWalk(s, medium, (uint)i, vload3(0, path.throughput), seed) : noWalk();
  marks[i] = within ? 1 : 0;
}

// One work-item per ray. walks [count] -> throughputs of paths. Light sampling does not find light that a walk has
// scattered.
__kernel void endWalks(const uint count, __global const MediumWalk* walks, __global const uint* numbers,
                       __global PathState* paths) {
  const size_t i = get_global_id(0);
  if (i >= count || walks[i].medium == PRELIGHT_NO_MEDIUM) return;
  __global PathState* path = paths + numbers[i];
  vstore3(vload3(0, walks[i].weight), 0, path->throughput);
  if (walks[i].steps == 0u) return;
  path->scatterDensity = path->behind = 0.0f;
  path->seesWalls = 1u;
}
