// Tracing of a buffer of rays through the wide tree. Options: those of bvh/wide_funcs.cl.
#include "bvh/wide_funcs.cl"

// One work-item per batch of rays. rays [firstRay + rayCount], from index firstRay on -> hits [rayCount]. The hint
// keeps compilers from joining work-items into vectors: the rays of one work-item already fill them.
__kernel __attribute__((vec_type_hint(float16))) void traceRays(__global const WideNode* nodes, __global const TriangleBlock* blocks,
                        __global const DeviceInstance* instances, __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                        __global const Ray* rays, __global Hit* hits, const uint firstRay, const uint rayCount) {
  const size_t first = get_global_id(0) * PRELIGHT_BATCH;
  if (first >= rayCount) return;
  const uint count = min((uint)(rayCount - first), (uint)PRELIGHT_BATCH);
  const Bvh bvh = {nodes, blocks, instances};
  const Surface surface = surfaceOf(layout, surfaceLines);
  Batch batch;
  prepareBatch(rays + firstRay + first, count, &batch);
  traceBatch(bvh, surface, &batch);
  writeHits(&batch, count, hits + first);
}
