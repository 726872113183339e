// What a path finds where it meets the surface.
// Options: PRELIGHT_LAYER_TEXTURES (some material has a texture), and those of the
// surface (bvh/alpha_funcs.cl).
#ifndef PRELIGHT_SHADE_VERTEX_FUNCS_CL
#define PRELIGHT_SHADE_VERTEX_FUNCS_CL

#include "bvh/alpha_funcs.cl"
#include "core/offset_funcs.cl"
#include "shade/bsdf_funcs.cl"
#include "shared/ray_types.h"
#include "shared/shade_types.h"

#define PRELIGHT_LAYER_BASE 0u
#define PRELIGHT_LAYER_SURFACE 1u  // G roughness, B metalness
#define PRELIGHT_LAYER_EMISSION 2u
#define PRELIGHT_LAYER_THROUGH 3u  // no texture yet: see loadBsdf
#define PRELIGHT_LAYERS 4u

typedef struct PathScene {
  Surface surface;  // its materials hold base colours without textures
  __global const float* vertices;  // [vertex][6] position, normal
  __global const uchar* flat;      // [triangle] 1: no shading normals
  __global const ShadeMaterial* materials;
  __global const DeviceMaterial* layers;    // [material][PRELIGHT_LAYERS] textures: PRELIGHT_LAYER_*
  __global const ushort4* layerTexels;
} PathScene;

typedef struct PathVertex {
  float3 position;
  float3 error;      // bound of the position's rounding
  float3 wo;         // unit, back along the ray
  float3 geometric;  // unit normals, both on the side that the ray came from
  float3 shading;
  bool front;
  uint triangle;
  uint material;
  float u, v;
} PathVertex;

float3 vertexPosition(PathScene s, uint vertex) { return vload3(0, s.vertices + 6 * (size_t)vertex); }

// Unit normal of the triangle's front.
float3 frontNormal(float3 a, float3 b, float3 c) {
  const float3 e = b - a, f = c - a;
  const float scale = 1.0f / fmax(fmax(largest(fabs(e)), largest(fabs(f))), 1e-36f);
  return normalize(cross(e * scale, f * scale));
}

// Shading normal on the front side; the geometric one where the file has none or it vanishes.
float3 shadingNormal(PathScene s, uint triangle, float u, float v, float3 front) {
  if (s.flat[triangle] != 0) return front;
  const DeviceTriangle t = s.surface.triangles[triangle];
  const float3 n = (1.0f - u - v) * vload3(0, s.vertices + 6 * (size_t)t.vertex[0] + 3) +
                   u * vload3(0, s.vertices + 6 * (size_t)t.vertex[1] + 3) +
                   v * vload3(0, s.vertices + 6 * (size_t)t.vertex[2] + 3);
  const float square = dot(n, n);
  if (!(square > 1e-12f)) return front;
  const float3 unit = n * rsqrt(square);
  return dot(unit, front) < 0.0f ? -unit : unit;
}

PathVertex loadVertex(PathScene s, Ray ray, Hit hit) {
  const DeviceTriangle t = s.surface.triangles[hit.triangle];
  const float3 a = vertexPosition(s, t.vertex[0]), b = vertexPosition(s, t.vertex[1]), c = vertexPosition(s, t.vertex[2]);
  PathVertex p;
  p.triangle = hit.triangle;
  p.material = t.material;
  p.u = hit.u;
  p.v = hit.v;
  p.position = pointOnTriangle(a, b, c, hit.u, hit.v);
  p.error = pointError(a, b, c, hit.u, hit.v);
  p.wo = -vload3(0, ray.direction);
  const float3 front = frontNormal(a, b, c);
  const float3 shading = shadingNormal(s, hit.triangle, hit.u, hit.v, front);
  p.front = dot(p.wo, front) >= 0.0f;
  p.geometric = p.front ? front : -front;
  p.shading = p.front ? shading : -shading;
  return p;
}

float2 vertexTexCoord(PathScene s, uint triangle, float u, float v) {
  const DeviceTriangle t = s.surface.triangles[triangle];
  return (1.0f - u - v) * s.surface.texCoords[t.vertex[0]] + u * s.surface.texCoords[t.vertex[1]] +
         v * s.surface.texCoords[t.vertex[2]];
}

// Texture `layer` of a material at a point; white where there is none.
float4 sampleLayer(PathScene s, uint layer, uint triangle, float u, float v) {
#ifdef PRELIGHT_LAYER_TEXTURES
  __global const DeviceMaterial* m = s.layers + PRELIGHT_LAYERS * s.surface.triangles[triangle].material + layer;
  if (m->texelOffset != PRELIGHT_NO_TEXTURE) {
    Surface texels = s.surface;
    texels.texels = s.layerTexels;
    return sampleTexture(texels, m, vertexTexCoord(s, triangle, u, v));
  }
#endif
  return (float4)(1.0f);
}

// Radiance that a point of a triangle sends out.
float3 emittedRadiance(PathScene s, uint triangle, float u, float v, bool front) {
  __global const ShadeMaterial* m = s.materials + s.surface.triangles[triangle].material;
  if (!front && (m->flags & PRELIGHT_DOUBLE_SIDED) == 0u) return (float3)(0.0f);
  return vload3(0, m->emission) * sampleLayer(s, PRELIGHT_LAYER_EMISSION, triangle, u, v).xyz;
}

// Factor, texture and vertex colour of a point.
float3 baseColor(PathScene s, uint triangle, float u, float v) {
  return clamp(surfaceColor(s.surface, triangle, u, v).xyz * sampleLayer(s, PRELIGHT_LAYER_BASE, triangle, u, v).xyz,
               0.0f, 1.0f);
}

#ifdef PRELIGHT_TRANSLUCENT
// Divides the body's light between its two sides. `opaque`: share of the surface that is neither metal nor glass.
// What the layer keeps from leaving is scattered again: of the light that has entered, as much comes through as the
// material says. So the layer's mean passage, which evaluateBsdf takes off on the way out, is made up for.
void setTransmitted(__global const DeviceMaterial* layer, float opaque, Bsdf* b) {
  const float share = layer->alphaFactor;
  b->diffuse *= 1.0f - share;
  b->transmitted = fmin(vload3(0, layer->albedo), opaque * share) / fmax(1.0f - largest(meanLayer(*b)), 1e-6f);
}
#endif

Bsdf loadBsdf(PathScene s, PathVertex p) {
  __global const ShadeMaterial* m = s.materials + p.material;
  const float4 layer = sampleLayer(s, PRELIGHT_LAYER_SURFACE, p.triangle, p.u, p.v);
  const float3 base = baseColor(s, p.triangle, p.u, p.v) * ((m->flags & PRELIGHT_UNLIT) != 0u ? 0.0f : 1.0f);
  const float metallic = m->metallic * layer.z;
  const float roughness = m->roughness * layer.y;
  const float opaque = (1.0f - metallic) * (1.0f - m->transmission);
  Bsdf b;
  b.diffuse = opaque * base;
  b.metal = metallic * base;
  b.f0 = vload3(0, m->f0);
  b.f90 = m->f90;
  b.layer = m->f90 > 0.0f ? opaque : 0.0f;
  b.glass = (m->flags & PRELIGHT_UNLIT) != 0u ? 0.0f : (1.0f - metallic) * m->transmission;
  b.tint = base;
  b.ior = m->ior;
  b.alpha = roughness * roughness;
  b.smooth = roughness < PRELIGHT_SMOOTH_BELOW;
#ifdef PRELIGHT_TRANSLUCENT
  setTransmitted(s.layers + PRELIGHT_LAYERS * p.material + PRELIGHT_LAYER_THROUGH, opaque, &b);
#endif
  return b;
}

typedef struct Frame {
  float3 x, y, z;
} Frame;

Frame frameAround(float3 n) {
  Frame f;
  f.z = n;
  makeFrame(n, &f.x, &f.y);
  return f;
}

float3 toFrame(Frame f, float3 d) { return (float3)(dot(d, f.x), dot(d, f.y), dot(d, f.z)); }
float3 fromFrame(Frame f, float3 d) { return d.x * f.x + d.y * f.y + d.z * f.z; }

Ray rayFrom(PathVertex p, float3 direction, float tMax) {
  Ray ray;
  vstore3(offsetOrigin(p.position, p.error, p.geometric, direction), 0, ray.origin);
  ray.sourceTriangle = p.triangle;  // a straight ray meets its plane but once
  vstore3(direction, 0, ray.direction);
  ray.tMax = tMax;
  return ray;
}

#endif
