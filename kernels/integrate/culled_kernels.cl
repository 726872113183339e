// Backs of one-sided surfaces, which pictures do not show: eye rays, those of the camera and those that only mirrors
// and glass have redirected, continue through them. Runs between trace and the other kernels of a step:
//   listCulled -> [trace -> keepBeyond -> listCulled] ...
// Options: those of the included files.
#ifndef PRELIGHT_REFERENCE_CULLED_KERNELS_CL
#define PRELIGHT_REFERENCE_CULLED_KERNELS_CL

#include "integrate/path_funcs.cl"
#include "transport/scene_funcs.cl"

// One work-item per traced ray. -> beyond [count], rays that continue from the backs that were met, and marks.
__kernel void listCulled(__constant const ReferenceParameters* p, const uint count, __global const SurfaceLine* surfaceLines,
                         __global const ShadingLine* shadingLines, __global const Ray* rays, __global const Hit* hits,
                         __global const uint* numbers, __global const PathState* paths, __global Ray* beyond,
                         __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  marks[i] = 0;
  const Hit hit = hits[i];
  if (hit.triangle == PRELIGHT_NO_TRIANGLE || paths[numbers[i]].seesWalls != 0u) return;
  const PathScene s = shadedSurfaceOf(&p->scene, surfaceLines, shadingLines);
  const DeviceTriangle t = triangleAt(s.surface, hit.triangle);
  if (!isCulled(s.materials[t.material].flags)) return;
  const float3 a = vertexPosition(s, t.vertex[0]), b = vertexPosition(s, t.vertex[1]), c = vertexPosition(s, t.vertex[2]);
  const float3 direction = vload3(0, rays[i].direction), front = frontNormal(a, b, c);
  if (dot(direction, front) <= 0.0f) return;
  const float3 point = pointOnTriangle(a, b, c, hit.u, hit.v), error = pointError(a, b, c, hit.u, hit.v);
  Ray ray;
  vstore3(offsetOrigin(point, error, front, direction), 0, ray.origin);
  ray.sourceTriangle = hit.triangle;
  vstore3(direction, 0, ray.direction);
  ray.tMax = rays[i].tMax < MAXFLOAT ? rays[i].tMax - hit.t : MAXFLOAT;
  beyond[i] = ray;
  marks[i] = 1;
}

// One work-item per continued ray, in the order of lists from firstListed on. found [count], the hits of the continued
// rays -> hits, as if the backs were not there.
__kernel void keepBeyond(const uint count, const uint firstListed, __global const uint* lists, __global const Hit* found,
                         __global Hit* hits) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const uint at = lists[firstListed + i];
  Hit hit = found[i];
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) hit.t += hits[at].t;
  hits[at] = hit;
}

#endif
