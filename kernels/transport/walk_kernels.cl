// Steps of walks within bodies, shared by all kernels that begin walks:
//   [a kernel that begins walks] -> [stepWalks -> trace] ...
// Options: those of transport/material_funcs.cl.
#include "transport/scene_funcs.cl"
#include "transport/walk_funcs.cl"

// One work-item per walk, at the end of its ray. rays, hits, walks [count] -> either the walk goes on in the same place
// from `next` on and is marked, or it is done: endRays, endHits, ends [origin]. An absorbed walk ends with weight 0 and
// without a surface.
__kernel void stepWalks(const uint count, const uint next, __constant const SceneLayout* layout,
                        __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines, __global Ray* rays,
                        __global const Hit* hits, __global MediumWalk* walks, __global Ray* endRays, __global Hit* endHits,
                        __global MediumWalk* ends, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  marks[i] = 0;
  const PathScene s = shadedSurfaceOf(layout, surfaceLines, shadingLines);
  MediumWalk walk = walks[i];
  Ray ray = rays[i];
  Hit hit = hits[i];
  if (!meetsSurface(s, hit, &walk)) {
    if (scatterWalk(s, &ray, &walk)) {
      rays[next + i] = ray;
      walks[next + i] = walk;
      marks[i] = 1;
      return;
    }
    vstore3((float3)(0.0f), 0, walk.weight);
    hit.triangle = PRELIGHT_NO_TRIANGLE;
  }
  endRays[walk.origin] = ray;
  endHits[walk.origin] = hit;
  ends[walk.origin] = walk;
}
