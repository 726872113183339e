// Denoiser guides: albedo and normal of the first surface that is neither mirror nor glass, per camera ray. Paths hold
// them in `radiance` and `arriving`.
//   generatePaths -> [trace -> followGuides] ... -> averageGuides
// Options: those of the included files.
#include "integrate/culled_kernels.cl"
#include "integrate/path_ends_kernels.cl"
#include "integrate/path_point_funcs.cl"
#include "transport/scene_funcs.cl"

// Returns about how much a surface reflects towards the eye under a uniform sky of radiance 1.
PRELIGHT_INLINE float3 guideAlbedo(Interaction i, Bsdf b) {
  if ((i.flags & PRELIGHT_UNLIT) != 0u) return (float3)(0.0f);  // its colour is emitted
  float3 albedo = b.diffuse + specularAlbedo(b, (float3)(i.woLocal.xy, fmax(i.woLocal.z, 0.0f)));
#ifdef PRELIGHT_TRANSLUCENT
  albedo += b.transmitted;
#endif
  return clamp(albedo + b.glass * b.tint, 0.0f, 1.0f);
}

PRELIGHT_INLINE void noteGuides(float3 albedo, float3 normal, PathState* path) {
  const float3 seen = vload3(0, path->radiance) + vload3(0, path->throughput) * albedo;
  vstore3(clamp(seen, 0.0f, 1.0f), 0, path->radiance);
  vstore3(normal, 0, path->arriving);
}

// One work-item per traced ray. Emission counts as albedo, so that the shapes of lights are kept. -> paths; rays that
// go on from step.next on, and marks.
__kernel void followGuides(__constant const ReferenceParameters* p, const PathStep step,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global const LightLine* lightLines, __global Ray* rays, __global const Hit* hits,
                           __global const uint* numbers, __global PathState* paths, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  marks[i] = 0;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  const uint number = numbers[i];
  PathState path = paths[number];
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(scene.surface, ray, hit);
  collectAt(p, step.depth, scene.surface, scene.lights, ray, hit, surface, &path);
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
    noteGuides((float3)(0.0f), (float3)(0.0f), &path);
  } else {
    const PathPoint at = dispersedAt(p, scene.surface, pathPointAt(scene.surface, surface, number), path);
    const bool rough = isDiffuse(at.bsdf) || isGlossy(at.bsdf) || (surface.flags & PRELIGHT_UNLIT) != 0u;
    Ray next;
    if (step.goesOn != 0u && !rough && scatterAt(p, step.depth, scene.surface, at, hit.t, &path, &next)) {
      rays[step.next + i] = next;
      marks[i] = 1u << PRELIGHT_PATH_NEXT;
    } else {
      noteGuides(guideAlbedo(surface, at.bsdf), surface.frame.z, &path);
    }
  }
  paths[number] = path;
}

// One work-item per pixel of the block. paths [pixel][samplesPerPass] -> means [pixel][albedo, normal], w unused.
__kernel void averageGuides(__constant const ReferenceParameters* p, __global const PathState* paths,
                            __global float4* means) {
  const size_t i = get_global_id(0);
  const uint n = p->samplesPerPass;
  if (i >= p->pathCount / n) return;
  means[2 * i] = (float4)(meanOf(paths[i * n].radiance, PRELIGHT_PATH_FLOATS, n), 0.0f);
  means[2 * i + 1] = (float4)(meanOf(paths[i * n].arriving, PRELIGHT_PATH_FLOATS, n), 0.0f);
}
