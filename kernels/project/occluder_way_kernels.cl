// Where light that shines on what a receiver sees comes from, other than by diffuse reflection: the mirrored direction
// (Sherif 2013, 7.2.4), and the direction behind all glass (7.2.3).
// Free is what meets nothing within `reach`, m. Options: those of the surface (bvh/alpha_funcs.cl).
#define PRELIGHT_GLOSSY
#define PRELIGHT_MIRROR
#define PRELIGHT_GLASS
#include "shared/cast_types.h"
#include "shared/occluder_types.h"
#include "transport/material_funcs.cl"
#include "transport/medium_funcs.cl"

#define PRELIGHT_ALWAYS 0.99999994f      // a chance that only total reflection is above
#define PRELIGHT_LEAST_THROUGHPUT 1e-3f  // what is darker is as good as blocked

bool materialHas(Hit hit, __global const DeviceTriangle* triangles, __global const uint* flags, uint flag) {
  return hit.triangle != PRELIGHT_NO_TRIANGLE && (flags[triangles[hit.triangle].material] & flag) != 0u;
}

// A ray a work-item. rays, hits [ray] -> mirrored [ray], and mirrorRays [counter] that find out whether they are open.
__kernel void listMirrored(__constant const CastParameters* parameters, __global const Ray* rays,
                           __global const Hit* hits, __global const uint* flags,
                           __global const DeviceTriangle* triangles, __global const DeviceMaterial* bases,
                           __global const float2* texCoords, __global const float4* colors,
                           __global const ushort4* texels, __global const float* vertices,
                           __global const uchar* flat, __global const ShadeMaterial* materials,
                           const float reach, __global OccluderWay* mirrored, __global Ray* mirrorRays, __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  mirrored[i].share = 0.0f;
  if (!materialHas(hits[i], triangles, flags, PRELIGHT_OCCLUDER_SHINY)) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, 0, 0};
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
  vstore3(clamp(specularReflectance(bsdf, cosine) + glass, 0.0f, 1.0f), 0, way.color);
  way.slot = atomic_inc(counter);
  mirrored[i] = way;
  mirrorRays[way.slot] = rayFrom(surface, direction, reach);
}

// A ray a work-item. rays, hits [ray] -> through [ray], blocked as yet, and the paths of those that met glass with their
// rays and hits [counter]. Next: followGlass.
__kernel void listGlass(__constant const CastParameters* parameters, __global const Ray* rays, __global const Hit* hits,
                        __global const uint* flags, __global const DeviceTriangle* triangles,
                        __global OccluderWay* through, __global GlassPath* paths, __global Ray* pathRays,
                        __global Hit* pathHits, __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= (size_t)parameters->receiverCount * parameters->raysPerReceiver) return;
  through[i].share = 0.0f;
  if (!materialHas(hits[i], triangles, flags, PRELIGHT_OCCLUDER_GLASS)) return;
  const uint slot = atomic_inc(counter);
  paths[slot] = (GlassPath){{1.0f, 1.0f, 1.0f}, (uint)i, PRELIGHT_NO_MEDIUM};
  pathRays[slot] = rays[i];
  pathHits[slot] = hits[i];
}

// A path a work-item, at the end of its ray. What has reached free space is a way through; what meets more glass goes on
// in nextPaths and nextRays [counter]; all else is blocked. Of what a face reflects, only total reflection is followed.
__kernel void followGlass(const uint count, __global const GlassPath* paths, __global const Ray* rays,
                          __global const Hit* hits, __global const uint* flags,
                          __global const DeviceTriangle* triangles, __global const DeviceMaterial* bases,
                          __global const float2* texCoords, __global const float4* colors,
                          __global const ushort4* texels, __global const float* vertices, __global const uchar* flat,
                          __global const ShadeMaterial* materials, const float reach, __global OccluderWay* through,
                          __global GlassPath* nextPaths, __global Ray* nextRays, __global uint* counter) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  GlassPath path = paths[i];
  const float3 throughput = vload3(0, path.throughput);
  const bool glass = materialHas(hits[i], triangles, flags, PRELIGHT_OCCLUDER_GLASS);
  const bool away = hits[i].triangle == PRELIGHT_NO_TRIANGLE || hits[i].t > reach;
  if (!glass && away && path.medium == PRELIGHT_NO_MEDIUM) {
    vstore3(vload3(0, rays[i].direction), 0, through[path.ray].vector);
    vstore3(throughput, 0, through[path.ray].color);
    through[path.ray].share = 1.0f;
    return;
  }
  if (!glass) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, 0, 0};
  const Interaction surface = loadInteraction(s, rays[i], hits[i]);
  const Bsdf bsdf = loadBsdf(s, surface);
  const GlassSample sample = sampleGlassRadiance(surface, bsdf, PRELIGHT_ALWAYS);
  // Light that is reflected off the outside never was on its way through.
  if (!sample.passes && (surface.front || !isSolid(surface))) return;
  float3 weight = sample.weight;
  if (sample.passes) weight *= bsdf.glass * (1.0f - sample.reflected);
  // A receiver may lie within glass.
  const uint medium = mediumBefore(surface, path.medium);
  if (medium != PRELIGHT_NO_MEDIUM) weight *= transmittance(s, medium, hits[i].t);
  if (sample.passes) path.medium = mediumAfter(surface, PRELIGHT_LOBE_GLASS_TRANSMISSION, path.medium);
  const float3 left = throughput * weight;
  if (!(largest(left) > PRELIGHT_LEAST_THROUGHPUT)) return;
  vstore3(left, 0, path.throughput);
  const uint slot = atomic_inc(counter);
  nextPaths[slot] = path;
  nextRays[slot] = rayFrom(surface, normalize(sample.direction), MAXFLOAT);
}
