// Instant radiosity (Keller 1997): light paths leave virtual point lights where they meet diffuse surfaces. Those on
// translucent ones shine to both sides.
// Options: those of the included files.
#include "core/octahedral_funcs.cl"
#include "reference/path_funcs.cl"
#include "shared/photon_types.h"

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
  const Bsdf bsdf = loadBsdf(s, surface);
  const float arrives = fmax(surface.woLocal.z, 0.0f);
  const float enters = 1.0f - largest(schlick(bsdf, arrives));
  // Shading normals of light traced from its source: Veach 1997, eq. 5.19.
  const float bent = arrives / fmax(dot(surface.wo, surface.geometric), 1e-6f);
  VirtualLight light;
  vstore3(surface.position, 0, light.position);
  light.triangle = photon.triangle;
  vstore3(surface.frame.z, 0, light.normal);
  light.f0 = largest(bsdf.f0);
  vstore3(vload3(0, photon.power) * bsdf.diffuse * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.intensity);
  vstore3((float3)(0.0f), 0, light.through);
#ifdef PRELIGHT_TRANSLUCENT
  vstore3(vload3(0, photon.power) * bsdf.transmitted * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.through);
#endif
  light.f90 = bsdf.f90;
  vstore3(surface.geometric, 0, light.geometric);
  light.pad = light.pad2 = 0u;
  lights[i] = light;
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
  const float3 way = vload3(0, light.position) - surface.position;
  const float square = dot(way, way);
  if (!(square > 1e-18f)) return;
  const float3 direction = way * rsqrt(square);
  float cosine = -dot(direction, vload3(0, light.normal)), leaving = -dot(direction, vload3(0, light.geometric));
  float3 intensity = vload3(0, light.intensity);
#ifdef PRELIGHT_TRANSLUCENT
  if (cosine < 0.0f && leaving < 0.0f) {
    intensity = vload3(0, light.through);
    cosine = -cosine;
    leaving = -leaving;
  }
#endif
  if (cosine <= 0.0f || leaving <= 0.0f) return;
  const Bsdf bsdf = loadBsdf(s, surface);
  if (!isDiffuse(bsdf) && !isGlossy(bsdf)) return;
  Scattered f;
  if (!evalBsdf(surface, bsdf, direction, PRELIGHT_RADIANCE, &f)) return;
  const float grazing = 1.0f - clamp(cosine, 0.0f, 1.0f), g2 = grazing * grazing;
  const float leaves = 1.0f - (light.f0 + (light.f90 - light.f0) * (g2 * g2 * grazing));
  const float3 radiance = vload3(0, paths[queue[i]].throughput) * (f.diffuse + f.glossy) *
                          intensity * (leaving * leaves / fmax(square, leastSquare));
  if (largest(radiance) <= 0.0f) return;
  const uint slot = atomic_inc(counters);
  Ray shadow = rayFrom(surface, direction, 0.0f);
  const float3 span = vload3(0, light.position) - vload3(0, shadow.origin);
  const bool ahead = dot(span, direction) > 0.0f;
  if (ahead) vstore3(span, 0, shadow.direction);
  shadow.tMax = ahead ? 0.9999f : 0.0f;
  shadowRays[slot] = shadow;
  ShadowItem item;
  vstore3(radiance, 0, item.radiance);
  item.path = queue[i];
  items[slot] = item;
}
