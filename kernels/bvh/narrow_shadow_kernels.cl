// Tracing of shadow rays through the narrow tree in scenes where some surface lets part of the light through.
// Options: those of bvh/narrow_kernels.cl except PRELIGHT_ANY_HIT, and those of bvh/shadow_funcs.cl.
#define PRELIGHT_ANY_HIT
#define PRELIGHT_SHADOWS
#include "bvh/narrow_funcs.cl"

// One work-item per ray, as traceRays. shadingLines: read only with PRELIGHT_PANES. -> hits [rayCount]
// (core/shadow_share_funcs.cl).
__kernel void traceShadows(__global const NarrowNode* nodes, __global const NarrowTriangle* leaves,
                           __global const DeviceInstance* instances, __constant const SceneLayout* layout,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global const Ray* rays, __global Hit* hits, const uint firstRay, const uint rayCount) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Bvh bvh = {nodes, leaves, instances};
  const Surface surface = surfaceOf(layout, surfaceLines);
  ShadowScene scene;
#ifdef PRELIGHT_PANES
  scene.panes = shadedSurfaceOf(layout, surfaceLines, shadingLines);
#endif
  RayTask task;
  task.ray = rays[firstRay + i];
  task.scene = &scene;
  startShadow(&task.shadow);
  const Hit hit = traceRay(bvh, surface, task.ray, &task);
  hits[i] = hit.triangle == PRELIGHT_NO_TRIANGLE ? shadowHit(&task.shadow) : hit;
}
