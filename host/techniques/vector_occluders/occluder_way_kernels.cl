// Directions from which light comes to the surfaces that a receiver sees, other than for diffuse reflection: the
// mirrored direction (Sherif 2013, 7.2.4), and the direction behind all glass (7.2.3). A direction is free when nothing
// lies within `reach`, m.
// Options: those of the surface (transport/alpha_funcs.cl).
#define PRELIGHT_GLOSSY
#define PRELIGHT_MIRROR
#define PRELIGHT_GLASS
#include "techniques/vector_occluders/occluder_scene_funcs.cl"
#include "shared/cast_types.h"
#include "shared/occluder_types.h"
#include "transport/medium_funcs.cl"
#include "transport/scene_funcs.cl"

#define PRELIGHT_ALWAYS 0.99999994f      // a random number that only total reflection exceeds
#define PRELIGHT_LEAST_THROUGHPUT 1e-3f  // paths that carry less count as blocked

bool materialHas(Hit hit, Surface surface, __global const uint* flags, uint flag) {
  return hit.triangle != PRELIGHT_NO_TRIANGLE && (flags[materialAt(surface, hit.triangle)] & flag) != 0u;
}

// One work-item per ray. rays, hits [ray] -> ways [ray], mirrorRays [ray] that test whether they are open, and marks.
// Next: numberMirrored.
__kernel void listMirrored(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global const OccluderLine* occluderLines, __global const Ray* rays,
                           __global const Hit* hits, const float reach, __global OccluderWay* ways,
                           __global Ray* mirrorRays, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  __global OccluderWay* mirrored = ways + PRELIGHT_WAYS * i + PRELIGHT_WAY_MIRRORED;
  mirrored->share = 0.0f;
  marks[i] = 0;
  const PathScene s = shadedSurfaceOf(layout, surfaceLines, shadingLines);
  __global const uint* flags = occludersOf(layout, occluderLines).flags;
  if (!materialHas(hits[i], s.surface, flags, PRELIGHT_OCCLUDER_SHINY)) return;
  const Interaction surface = loadInteraction(s, rays[i], hits[i]);
  if (!surface.front && (flags[surface.material] & PRELIGHT_OCCLUDER_TWO_SIDED) == 0u) return;
  const Bsdf bsdf = loadBsdf(s, surface);
  const float cosine = surface.woLocal.z;
  const float3 direction = mirrorAbout(surface.wo, surface.frame.z);
  if (cosine <= 0.0f || dot(direction, surface.geometric) <= 0.0f) return;
  OccluderWay way;
  vstore3(surface.frame.z, 0, way.vector);
  way.share = 1.0f;
  const float glass = bsdf.glass * sampleGlassAbout(surface, bsdf, surface.frame.z, PRELIGHT_ALWAYS).reflected;
  vstore3(clamp(specularAlbedo(bsdf, (float3)(0.0f, 0.0f, cosine)) + glass, 0.0f, 1.0f), 0, way.color);
  *mirrored = way;
  mirrorRays[i] = rayFrom(surface, direction, reach);
  marks[i] = 1;
}

// One work-item per listed mirrored way: stores the index of its ray in the list.
__kernel void numberMirrored(const uint count, const uint firstListed, __global const uint* lists,
                             __global OccluderWay* ways) {
  const size_t i = get_global_id(0);
  if (i < count) ways[PRELIGHT_WAYS * (size_t)lists[firstListed + i] + PRELIGHT_WAY_MIRRORED].ray = (uint)i;
}

// One work-item per ray. hits [ray] -> ways [ray], blocked for now, and marks of the rays that met glass. Next:
// startGlass.
__kernel void listGlass(__constant const CastParameters* parameters, __constant const SceneLayout* layout,
                        __global const SurfaceLine* surfaceLines, __global const OccluderLine* occluderLines,
                        __global const Hit* hits, __global OccluderWay* ways, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  ways[PRELIGHT_WAYS * i + PRELIGHT_WAY_THROUGH].share = 0.0f;
  marks[i] = materialHas(hits[i], surfaceOf(layout, surfaceLines), occludersOf(layout, occluderLines).flags,
                         PRELIGHT_OCCLUDER_GLASS);
}

// One work-item per listed ray that met glass. rays, hits [ray] -> paths, pathRays, pathHits [count]. Next:
// followGlass.
__kernel void startGlass(const uint count, const uint firstListed, __global const uint* lists, __global const Ray* rays,
                         __global const Hit* hits, __global GlassPath* paths, __global Ray* pathRays,
                         __global Hit* pathHits) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const uint from = lists[firstListed + i];
  paths[i] = (GlassPath){{1.0f, 1.0f, 1.0f}, from, PRELIGHT_NO_MEDIUM};
  pathRays[i] = rays[from];
  pathHits[i] = hits[from];
}

// One work-item per path, at the end of its ray. A path that has reached free space is a way through; one that meets
// more glass goes on in the same place from step.next on and is marked; all others are blocked. Of reflections, only
// total reflection is followed.
__kernel void followGlass(__constant const SceneLayout* layout, const GlassStep step,
                          __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                          __global const OccluderLine* occluderLines, __global GlassPath* paths, __global Ray* rays,
                          __global const Hit* hits, __global OccluderWay* ways, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  marks[i] = 0;
  const PathScene s = shadedSurfaceOf(layout, surfaceLines, shadingLines);
  GlassPath path = paths[i];
  const Ray ray = rays[i];
  const float3 throughput = vload3(0, path.throughput);
  const bool glass = materialHas(hits[i], s.surface, occludersOf(layout, occluderLines).flags,
                                 PRELIGHT_OCCLUDER_GLASS);
  const bool away = hits[i].triangle == PRELIGHT_NO_TRIANGLE || hits[i].t > step.reach;
  if (!glass && away && path.medium == PRELIGHT_NO_MEDIUM) {
    __global OccluderWay* through = ways + PRELIGHT_WAYS * (size_t)path.ray + PRELIGHT_WAY_THROUGH;
    vstore3(vload3(0, ray.direction), 0, through->vector);
    vstore3(throughput, 0, through->color);
    through->share = 1.0f;
    return;
  }
  if (!glass) return;
  const Interaction surface = loadInteraction(s, ray, hits[i]);
  const Bsdf bsdf = loadBsdf(s, surface);
  const GlassSample sample = sampleGlassRadiance(surface, bsdf, PRELIGHT_ALWAYS);
  // Light that is reflected off the outside was never inside the glass.
  if (!sample.passes && (surface.front || !isSolid(surface))) return;
  float3 weight = sample.weight;
  if (sample.passes) weight *= bsdf.glass * (1.0f - sample.reflected);
  // A receiver may lie within glass.
  const uint medium = mediumBefore(surface, path.medium);
  if (medium != PRELIGHT_NO_MEDIUM) weight *= unabsorbed(s, medium, hits[i].t);
  if (sample.passes) path.medium = mediumAfter(surface, PRELIGHT_LOBE_GLASS_TRANSMISSION, path.medium);
  const float3 left = throughput * weight;
  if (!(largest(left) > PRELIGHT_LEAST_THROUGHPUT)) return;
  vstore3(left, 0, path.throughput);
  marks[i] = 1;
  paths[step.next + i] = path;
  rays[step.next + i] = rayFrom(surface, normalize(sample.direction), MAXFLOAT);
}
