// Tracing of shadow rays through the wide tree in scenes where some surface lets part of the light through.
// Options: those of bvh/wide_funcs.cl and bvh/shadow_funcs.cl.
#define PRELIGHT_ANY_HIT
#define PRELIGHT_SHADOWS
#include "bvh/wide_funcs.cl"

// One work-item per batch of rays, as traceRays. shadingLines: read only with PRELIGHT_PANES. -> hits [rayCount]
// (core/shadow_share_funcs.cl).
__kernel __attribute__((vec_type_hint(float16))) void traceShadows(__global const WideNode* nodes, __global const TriangleBlock* blocks,
                        __global const DeviceInstance* instances, __constant const SceneLayout* layout,
                        __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                        __global const Ray* rays, __global Hit* hits, const uint firstRay, const uint rayCount) {
  const size_t first = get_global_id(0) * PRELIGHT_BATCH;
  if (first >= rayCount) return;
  const uint count = min((uint)(rayCount - first), (uint)PRELIGHT_BATCH);
  const Bvh bvh = {nodes, blocks, instances};
  const Surface surface = surfaceOf(layout, surfaceLines);
  Batch batch;
#ifdef PRELIGHT_PANES
  batch.scene.panes = shadedSurfaceOf(layout, surfaceLines, shadingLines);
#endif
  prepareBatch(rays + firstRay + first, count, &batch);
  traceBatch(bvh, surface, &batch);
  writeHits(&batch, count, hits + first);
}
