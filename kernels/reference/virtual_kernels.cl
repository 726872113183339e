// Instant radiosity (Keller 1997): light paths leave virtual point lights where they meet diffuse surfaces. Those on
// translucent ones shine to both sides.
// Options: those of the included files.
#include "core/octahedral_funcs.cl"
#include "reference/path_funcs.cl"
#include "shade/scene_funcs.cl"
#include "shared/photon_types.h"

// Barycentric weights of a triangle's vertices 1 and 2 of a point in its plane.
float2 placeOnTriangle(float3 a, float3 b, float3 c, float3 point) {
  const float3 e = b - a, f = c - a, p = point - a;
  const float ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), pe = dot(p, e), pf = dot(p, f);
  const float scale = 1.0f / fmax(ee * ff - ef * ef, 1e-36f);
  return clamp((float2)(ff * pe - ef * pf, ee * pf - ef * pe) * scale, 0.0f, 1.0f);
}

// A photon a work-item -> lights [photon]. Its power is scattered diffusely where it landed.
__kernel void makeVirtualLights(const uint count, __constant const SceneLayout* layout,
                                __global const SurfaceLine* surface, __global const ShadingLine* shading,
                                __global const Photon* photons, __global VirtualLight* lights) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const PathScene s = shadedSurfaceOf(layout, surface, shading);
  const Photon photon = photons[i];
  const DeviceTriangle t = s.surface.triangles[photon.triangle];
  const float3 at = vload3(0, photon.position);
  const float2 place = placeOnTriangle(vertexPosition(s, t.vertex[0]), vertexPosition(s, t.vertex[1]),
                                       vertexPosition(s, t.vertex[2]), at);
  Ray ray;
  vstore3(-unpackDirection(photon.direction), 0, ray.direction);
  Hit hit;
  hit.triangle = photon.triangle;
  hit.u = place.x;
  hit.v = place.y;
  const PathVertex vertex = loadVertex(s, ray, hit);
  const Bsdf bsdf = loadBsdf(s, vertex);
  const float arrives = fmax(dot(vertex.wo, vertex.shading), 0.0f);
  const float enters = 1.0f - largest(schlick(bsdf, arrives));
  // Shading normals of light traced from its source: Veach 1997, eq. 5.19.
  const float bent = arrives / fmax(dot(vertex.wo, vertex.geometric), 1e-6f);
  VirtualLight light;
  vstore3(vertex.position, 0, light.position);
  light.triangle = photon.triangle;
  vstore3(vertex.shading, 0, light.normal);
  light.f0 = largest(bsdf.f0);
  vstore3(vload3(0, photon.power) * bsdf.diffuse * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.intensity);
  vstore3((float3)(0.0f), 0, light.through);
#ifdef PRELIGHT_TRANSLUCENT
  vstore3(vload3(0, photon.power) * bsdf.transmitted * (PRELIGHT_INVERSE_PI * enters * bent), 0, light.through);
#endif
  light.f90 = bsdf.f90;
  vstore3(vertex.geometric, 0, light.geometric);
  light.pad = light.pad2 = 0u;
  lights[i] = light;
}

// A ray a work-item. Light that could arrive from virtual light step.light where the ray ends. -> shadow rays and items
// [shadow counter].
__kernel void sampleVirtualLight(__constant const ReferenceParameters* p, const PathStep step,
                                 __global const SurfaceLine* surface, __global const ShadingLine* shading,
                                 __global Ray* rays, __global const Hit* hits, __global uint* queue,
                                 __global const PathState* paths, __global const VirtualLight* lights,
                                 __global ShadowItem* items) {
  const size_t i = get_global_id(0);
  if (i >= step.count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const VirtualLight light = lights[step.light];
  const PathScene s = shadedSurfaceOf(&p->scene, surface, shading);
  const uint number = queue[PRELIGHT_QUEUE_HEAD + step.first + i];
  const PathVertex vertex = loadVertex(s, rays[step.first + i], hits[i]);
  const float3 way = vload3(0, light.position) - vertex.position;
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
  const Bsdf bsdf = loadBsdf(s, vertex);
  if (!isDiffuse(bsdf) && !isGlossy(bsdf)) return;
  const Frame frame = frameAround(vertex.shading);
  const float3 wo = toFrame(frame, vertex.wo), wi = toFrame(frame, direction);
  if (wo.z <= 0.0f || !maySee(bsdf, wi.z, dot(direction, vertex.geometric))) return;
  const Reflection f = evaluateBsdf(bsdf, wo, wi);
  const float grazing = 1.0f - clamp(cosine, 0.0f, 1.0f), g2 = grazing * grazing;
  const float leaves = 1.0f - (light.f0 + (light.f90 - light.f0) * (g2 * g2 * grazing));
  const float3 radiance = vload3(0, paths[number].throughput) * (f.diffuse + f.glossy) *
                          intensity * (leaving * leaves / fmax(square, step.leastSquare));
  if (largest(radiance) <= 0.0f) return;
  const uint slot = atomic_inc(queue + PRELIGHT_SHADOW_COUNTER);
  Ray shadow = rayFrom(vertex, direction, 0.0f);
  const float3 span = vload3(0, light.position) - vload3(0, shadow.origin);
  const bool ahead = dot(span, direction) > 0.0f;
  if (ahead) vstore3(span, 0, shadow.direction);
  shadow.tMax = ahead ? 0.9999f : 0.0f;
  rays[step.shadow + slot] = shadow;
  ShadowItem item;
  vstore3(radiance, 0, item.radiance);
  item.path = number;
  items[slot] = item;
}
