// Instant radiosity (Keller 1997): light paths leave virtual point lights where they meet diffuse surfaces. Virtual
// lights on translucent surfaces shine to both sides.
// Options: those of the included files.
#include "core/octahedral_funcs.cl"
#include "core/surface_frame_funcs.cl"
#include "integrate/path_funcs.cl"
#include "integrate/path_parts_funcs.cl"
#include "shared/photon_types.h"
#include "transport/scene_funcs.cl"
#include "transport/virtual_light_funcs.cl"

// Returns the barycentric weights of a triangle's vertices 1 and 2 for a point in its plane.
float2 placeOnTriangle(float3 a, float3 b, float3 c, float3 point) {
  const float3 e = b - a, f = c - a, p = point - a;
  const float ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), pe = dot(p, e), pf = dot(p, f);
  const float scale = 1.0f / fmax(ee * ff - ef * ef, 1e-36f);
  return clamp((float2)(ff * pe - ef * pf, ee * pf - ef * pe) * scale, 0.0f, 1.0f);
}

// One work-item per photon -> lights [photon], which scatter the photon's power diffusely where it landed.
__kernel void makeVirtualLights(const uint count, __constant const SceneLayout* layout,
                                __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                                __global const Photon* photons, __global VirtualLight* lights) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const PathScene s = shadedSurfaceOf(layout, surfaceLines, shadingLines);
  const Photon photon = photons[i];
  const DeviceTriangle t = triangleAt(s.surface, photon.triangle);
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

// One work-item per ray. rays [light][raysPerLight], cosine-weighted, to the side to which a light shines most.
__kernel void castFromVirtualLights(const uint count, const uint raysPerLight, __global const VirtualLight* lights,
                                    __global Ray* rays) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const uint number = (uint)i / raysPerLight;
  const VirtualLight light = lights[number];
  const bool front = largest(vload3(0, light.intensity)) >= largest(vload3(0, light.through));
  const float3 normal = vload3(0, light.geometric) * (front ? 1.0f : -1.0f);
  const uint2 bits = samplePaddedBits((uint)i % raysPerLight, hashInteger(number + 0x2545f491u));
  const float2 u = (float2)(unitFloat(bits.x), unitFloat(bits.y));
  const float radius = sqrt(u.x), turn = 6.28318531f * u.y;
  const float3 tangent = surfaceTangent(normal);
  const float3 across = radius * (cos(turn) * tangent + sin(turn) * cross(normal, tangent));
  Ray ray;
  vstore3(vload3(0, light.position), 0, ray.origin);
  vstore3(normalize(across + sqrt(fmax(1.0f - u.x, 0.0f)) * normal), 0, ray.direction);
  ray.sourceTriangle = light.triangle;
  ray.tMax = MAXFLOAT;
  rays[i] = ray;
}

// One work-item per ray. Light of virtual light step.light that may arrive at the ray's end. -> shadow rays from
// step.shadow on, and marks.
__kernel void sampleVirtualLight(__constant const ReferenceParameters* p, const PathStep step,
                                 __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                                 __global Ray* rays, __global const Hit* hits, __global const uint* numbers,
                                 __global PathState* paths, __global const VirtualLight* lights,
                                 __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  marks[i] = 0;
  if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const uint number = numbers[i];
#ifdef PRELIGHT_PANES
  if (step.depth - paths[number].panes + 1u >= p->mostSegments) return;
#endif
  const VirtualLight light = lights[step.light];
  const PathScene s = shadedSurfaceOf(&p->scene, surfaceLines, shadingLines);
  const Interaction surface = loadInteraction(s, rays[i], hits[i]);
  VirtualSample sample;
  if (!sampleVirtual(s, light, surface.position, step.leastSquare, &sample)) return;
  const Bsdf bsdf = loadBsdf(s, surface);
  if (!isDiffuse(bsdf) && !isGlossy(bsdf)) return;
  Scattered f;
  if (!evalBsdf(surface, bsdf, sample.direction, PRELIGHT_RADIANCE, &f)) return;
  const float3 radiance = vload3(0, paths[number].throughput) * (f.diffuse + f.glossy) * sample.intensity * sample.falloff;
  if (largest(radiance) <= 0.0f) return;
  rays[step.shadow + i] = rayTo(surface, sample.direction, vload3(0, light.position), 0.9999f);
  vstore3(radiance, 0, paths[number].arriving);
  noteArriving(p, paths, number, PRELIGHT_PART_INDIRECT);
  marks[i] = 1u << PRELIGHT_PATH_SHADOW;
}
