// Where light that shines on what a receiver sees comes from, other than by diffuse reflection: the mirrored direction
// (Sherif 2013, 7.2.4), and the direction behind all glass (7.2.3).
// Free is what meets nothing within `reach`, m. Options: those of the surface (bvh/alpha_funcs.cl).
#define PRELIGHT_GLOSSY
#define PRELIGHT_MIRROR
#define PRELIGHT_GLASS
#include "project/occluder_scene_funcs.cl"
#include "shade/glass_funcs.cl"
#include "shade/scene_funcs.cl"
#include "shared/cast_types.h"
#include "shared/occluder_types.h"

#define PRELIGHT_ALWAYS 0.99999994f      // a chance that only total reflection is above
#define PRELIGHT_LEAST_THROUGHPUT 1e-3f  // what is darker is as good as blocked

bool materialHas(Hit hit, __global const DeviceTriangle* triangles, __global const uint* flags, uint flag) {
  return hit.triangle != PRELIGHT_NO_TRIANGLE && (flags[triangles[hit.triangle].material] & flag) != 0u;
}

// A ray a work-item. rays, hits [ray] -> ways [ray], and mirrorRays [counter] that find out whether they are open.
__kernel void listMirrored(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                           __global const SurfaceLine* surface, __global const ShadingLine* shading,
                           __global const OccluderLine* occluderLines, __global const Ray* rays,
                           __global const Hit* hits, const float reach, __global OccluderWay* ways,
                           __global Ray* mirrorRays, __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  __global OccluderWay* mirrored = ways + PRELIGHT_WAYS * i + PRELIGHT_WAY_MIRRORED;
  mirrored->share = 0.0f;
  const PathScene s = shadedSurfaceOf(layout, surface, shading);
  __global const uint* flags = occludersOf(layout, occluderLines).flags;
  if (!materialHas(hits[i], s.surface.triangles, flags, PRELIGHT_OCCLUDER_SHINY)) return;
  const PathVertex vertex = loadVertex(s, rays[i], hits[i]);
  if (!vertex.front && (flags[vertex.material] & PRELIGHT_OCCLUDER_TWO_SIDED) == 0u) return;
  const Bsdf bsdf = loadBsdf(s, vertex);
  const float cosine = dot(vertex.wo, vertex.shading);
  const float3 direction = 2.0f * cosine * vertex.shading - vertex.wo;
  if (cosine <= 0.0f || dot(direction, vertex.geometric) <= 0.0f) return;
  OccluderWay way;
  vstore3(vertex.shading, 0, way.vector);
  way.share = 1.0f;
  const bool solid = (s.materials[vertex.material].flags & PRELIGHT_SOLID) != 0u;
  const float glass = bsdf.glass * glassReflectance(bsdf, solid, vertex.front, glassCosine(vertex.wo, vertex.shading));
  vstore3(clamp(bsdf.metal + bsdf.layer * schlick(bsdf, cosine) + glass, 0.0f, 1.0f), 0, way.color);
  way.slot = atomic_inc(counter);
  *mirrored = way;
  mirrorRays[way.slot] = rayFrom(vertex, direction, reach);
}

// A ray a work-item. rays, hits [ray] -> ways [ray], blocked as yet, and the paths of those that met glass with their
// rays and hits [counter]. Next: followGlass.
__kernel void listGlass(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                        __global const SurfaceLine* surface, __global const OccluderLine* occluderLines,
                        __global const Ray* rays, __global const Hit* hits, __global OccluderWay* ways,
                        __global GlassPath* paths, __global Ray* pathRays, __global Hit* pathHits,
                        __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  ways[PRELIGHT_WAYS * i + PRELIGHT_WAY_THROUGH].share = 0.0f;
  if (!materialHas(hits[i], surfaceOf(layout, surface).triangles, occludersOf(layout, occluderLines).flags,
                   PRELIGHT_OCCLUDER_GLASS)) return;
  const uint slot = atomic_inc(counter);
  paths[slot] = (GlassPath){{1.0f, 1.0f, 1.0f}, (uint)i, PRELIGHT_NO_MEDIUM};
  pathRays[slot] = rays[i];
  pathHits[slot] = hits[i];
}

// Where light goes on behind the glass that a ray met, and what is left of it. False: nowhere worth following.
bool passGlassAt(PathScene s, PathVertex vertex, float distance, GlassPath* path, float3* direction) {
  const Bsdf bsdf = loadBsdf(s, vertex);
  const bool solid = (s.materials[vertex.material].flags & PRELIGHT_SOLID) != 0u;
  float3 n = dot(vertex.wo, vertex.shading) > 0.0f ? vertex.shading : vertex.geometric, weight;
  bool passes;
  float relativeIor2;
  *direction = throughGlass(bsdf, solid, vertex.front, vertex.wo, n, PRELIGHT_ALWAYS, &weight, &passes, &relativeIor2);
  if ((dot(*direction, vertex.geometric) < 0.0f) != passes) {
    n = vertex.geometric;
    *direction = throughGlass(bsdf, solid, vertex.front, vertex.wo, n, PRELIGHT_ALWAYS, &weight, &passes, &relativeIor2);
  }
  // Light that is reflected off the outside never was on its way through.
  if (!passes && (vertex.front || !solid)) return false;
  if (passes) weight *= bsdf.glass * (1.0f - glassReflectance(bsdf, solid, vertex.front, glassCosine(vertex.wo, n)));
  // A receiver may lie within glass.
  const uint medium = path->medium == PRELIGHT_NO_MEDIUM && solid && !vertex.front ? vertex.material : path->medium;
  if (medium != PRELIGHT_NO_MEDIUM) weight *= exp(-vload3(0, s.materials[medium].absorption) * distance);
  if (passes && solid) path->medium = vertex.front ? vertex.material : PRELIGHT_NO_MEDIUM;
  const float3 left = vload3(0, path->throughput) * weight;
  vstore3(left, 0, path->throughput);
  return largest(left) > PRELIGHT_LEAST_THROUGHPUT;
}

// A path a work-item, at the end of its ray. What has reached free space is a way through; what meets more glass goes on
// from step.next on [counter]; all else is blocked. Of what a face reflects, only total reflection is followed.
__kernel void followGlass(__constant const SceneLayout* layout, const GlassStep step,
                          __global const SurfaceLine* surface, __global const ShadingLine* shading,
                          __global const OccluderLine* occluderLines, __global GlassPath* paths, __global Ray* rays,
                          __global const Hit* hits, __global OccluderWay* ways, __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const PathScene s = shadedSurfaceOf(layout, surface, shading);
  GlassPath path = paths[step.first + i];
  const Ray ray = rays[step.first + i];
  const bool glass = materialHas(hits[i], s.surface.triangles, occludersOf(layout, occluderLines).flags,
                                 PRELIGHT_OCCLUDER_GLASS);
  const bool away = hits[i].triangle == PRELIGHT_NO_TRIANGLE || hits[i].t > step.reach;
  if (!glass && away && path.medium == PRELIGHT_NO_MEDIUM) {
    __global OccluderWay* through = ways + PRELIGHT_WAYS * (size_t)path.ray + PRELIGHT_WAY_THROUGH;
    vstore3(vload3(0, ray.direction), 0, through->vector);
    vstore3(vload3(0, path.throughput), 0, through->color);
    through->share = 1.0f;
    return;
  }
  if (!glass) return;
  const PathVertex vertex = loadVertex(s, ray, hits[i]);
  float3 direction;
  if (!passGlassAt(s, vertex, hits[i].t, &path, &direction)) return;
  const uint slot = atomic_inc(counter);
  paths[step.next + slot] = path;
  rays[step.next + slot] = rayFrom(vertex, normalize(direction), MAXFLOAT);
}
