// Instant radiosity (Keller 1997): light paths leave virtual point lights where they meet diffuse surfaces. Those on
// translucent ones shine to both sides.
// Options: those of the included files.
#include "core/octahedral_funcs.cl"
#include "reference/path_funcs.cl"
#include "shared/photon_types.h"
#include "transport/virtual_light_funcs.cl"

// Barycentric weights of a triangle's vertices 1 and 2 of a point in its plane.
float2 placeOnTriangle(float3 a, float3 b, float3 c, float3 point) {
  const float3 e = b - a, f = c - a, p = point - a;
  const float ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), pe = dot(p, e), pf = dot(p, f);
  const float scale = 1.0f / fmax(ee * ff - ef * ef, 1e-36f);
  return clamp((float2)(ff * pe - ef * pf, ee * pf - ef * pe) * scale, 0.0f, 1.0f);
}

// A photon a work-item -> lights [photon]. Its power is scattered diffusely where it landed.
__kernel void makeVirtualLights(const uint count, __global const Photon* photons,
                                __global const DeviceTriangle* triangles, __global const DeviceMaterial* bases,
                                __global const float2* texCoords, __global const float4* colors,
                                __global const ushort4* texels, __global const float* vertices,
                                __global const uchar* flat, __global const ShadeMaterial* materials,
                                __global const DeviceMaterial* layers, __global const ushort4* layerTexels,
                                __global VirtualLight* lights) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Photon photon = photons[i];
  const DeviceTriangle t = triangles[photon.triangle];
  const float3 at = vload3(0, photon.position);
  const float2 place = placeOnTriangle(vertexPosition(s, t.vertex[0]), vertexPosition(s, t.vertex[1]),
                                       vertexPosition(s, t.vertex[2]), at);
  Ray ray;
  vstore3(-unpackDirection(photon.direction), 0, ray.direction);
  Hit hit;
  hit.triangle = photon.triangle;
  hit.u = place.x;
  hit.v = place.y;
  const Interaction surface = loadInteraction(s, ray, hit);
  lights[i] = virtualLightAt(surface, loadBsdf(s, surface), vload3(0, photon.power));
}

// A ray a work-item. Light that could arrive from virtual light `index` where the ray ends; nearer than the square root
// of `leastSquare` it counts as at that distance. -> shadowRays, items [counters[0]].
__kernel void sampleVirtualLight(__constant const ReferenceParameters* p, const uint count, __global const Ray* rays,
                                 __global const Hit* hits, __global const uint* queue,
                                 __global const PathState* paths, __global const DeviceTriangle* triangles,
                                 __global const DeviceMaterial* bases, __global const float2* texCoords,
                                 __global const float4* colors, __global const ushort4* texels,
                                 __global const float* vertices, __global const uchar* flat,
                                 __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                                 __global const ushort4* layerTexels, __global const VirtualLight* lights,
                                 const uint index, const float leastSquare, __global Ray* shadowRays,
                                 __global ShadowItem* items, __global uint* counters) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const VirtualLight light = lights[index];
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Interaction surface = loadInteraction(s, rays[i], hits[i]);
  VirtualSample sample;
  if (!sampleVirtual(light, surface.position, leastSquare, &sample)) return;
  const Bsdf bsdf = loadBsdf(s, surface);
  if (!isDiffuse(bsdf) && !isGlossy(bsdf)) return;
  Scattered f;
  if (!evalBsdf(surface, bsdf, sample.direction, PRELIGHT_RADIANCE, &f)) return;
  const float3 radiance = vload3(0, paths[queue[i]].throughput) * (f.diffuse + f.glossy) * sample.intensity * sample.falloff;
  if (largest(radiance) <= 0.0f) return;
  const uint slot = atomic_inc(counters);
  shadowRays[slot] = rayTo(surface, sample.direction, vload3(0, light.position), 0.9999f);
  ShadowItem item;
  vstore3(radiance, 0, item.radiance);
  item.path = queue[i];
  items[slot] = item;
}
