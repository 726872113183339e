// What a hit finds on the surface: coverage (alpha mask) and diffuse albedo.
#ifndef PRELIGHT_BVH_ALPHA_FUNCS_CL
#define PRELIGHT_BVH_ALPHA_FUNCS_CL

#include "core/inline.h"
#include "shared/scene_layout_types.h"
#include "shared/scene_types.h"

typedef struct Surface {
  __global const DeviceTriangle* triangles;   // [stored triangle]
  __global const SurfaceRange* ranges;        // [range]; read only with PRELIGHT_SHARED_SURFACE
  uint rangeCount;
  __global const DeviceMaterial* materials;   // [material]
  __global const float2* texCoords;           // [stored vertex]
  __global const float4* colors;              // [stored vertex], linear; read only with PRELIGHT_VERTEX_COLORS
  __global const ushort4* texels;             // linear RGBA in 1/65535: decoded once, not at every hit
} Surface;

Surface surfaceOf(__constant const SceneLayout* layout, __global const SurfaceLine* surface) {
  const Surface s = {(__global const DeviceTriangle*)(surface + layout->triangles),
                     (__global const SurfaceRange*)(surface + layout->ranges), layout->rangeCount,
                     (__global const DeviceMaterial*)(surface + layout->materials),
                     (__global const float2*)(surface + layout->texCoords),
                     (__global const float4*)(surface + layout->colors),
                     (__global const ushort4*)(surface + layout->texels)};
  return s;
}

// Where a triangle of the scene is stored, and what takes its stored vertices to the scene's.
typedef struct StoredTriangle {
  uint index;
  uint vertexShift;
} StoredTriangle;

PRELIGHT_INLINE StoredTriangle storedTriangle(Surface s, uint triangle) {
#ifdef PRELIGHT_SHARED_SURFACE
  uint first = 0, end = s.rangeCount;
  while (end - first > 1u) {
    const uint middle = (first + end) / 2u;
    if (s.ranges[middle].firstTriangle <= triangle)
      first = middle;
    else
      end = middle;
  }
  const StoredTriangle stored = {triangle + s.ranges[first].triangleShift, s.ranges[first].vertexShift};
#else
  const StoredTriangle stored = {triangle, 0u};
#endif
  return stored;
}

// A triangle of the scene with the scene's vertices.
PRELIGHT_INLINE DeviceTriangle triangleAt(Surface s, uint triangle) {
  const StoredTriangle stored = storedTriangle(s, triangle);
  DeviceTriangle t = s.triangles[stored.index];
  for (int corner = 0; corner < 3; ++corner) t.vertex[corner] += stored.vertexShift;
  return t;
}

PRELIGHT_INLINE uint materialAt(Surface s, uint triangle) { return s.triangles[storedTriangle(s, triangle).index].material; }

// Texel coordinate of u in [0, size): wrapped with integers, as glTF samplers do.
uint wrapTexel(int i, uint size, uint mode) {
  const int n = (int)size;
  if (mode == PRELIGHT_WRAP_CLAMP) return (uint)clamp(i, 0, n - 1);
  if (mode == PRELIGHT_WRAP_MIRROR) {
    const int period = 2 * n;
    const int j = ((i % period) + period) % period;
    return (uint)(j < n ? j : period - 1 - j);
  }
  return (uint)(((i % n) + n) % n);
}

float4 fetchTexel(Surface s, __global const DeviceMaterial* m, int x, int y) {
  const uint at = m->texelOffset + wrapTexel(y, m->height, m->wrapT) * m->width + wrapTexel(x, m->width, m->wrapS);
  return convert_float4(s.texels[at]) * (1.0f / 65535.0f);
}

// Bilinear, linear RGB and alpha. Coordinates beyond 2^20 texels are folded, so that hostile ones stay integers.
float4 sampleTexture(Surface s, __global const DeviceMaterial* m, float2 uv) {
  float2 at = uv * (float2)((float)m->width, (float)m->height) - 0.5f;
  at = fmod(at, 1048576.0f);
  at = select(at, (float2)(0.0f), isnan(at));
  const float2 base = floor(at);
  const float2 f = at - base;
  const int x = (int)base.x, y = (int)base.y;
  return mix(mix(fetchTexel(s, m, x, y), fetchTexel(s, m, x + 1, y), f.x),
             mix(fetchTexel(s, m, x, y + 1), fetchTexel(s, m, x + 1, y + 1), f.x), f.y);
}

// Factor, texture and vertex colour of a point of a triangle: linear albedo and alpha.
PRELIGHT_INLINE float4 surfaceColor(Surface s, uint triangle, float u, float v) {
  const DeviceTriangle t = s.triangles[storedTriangle(s, triangle).index];
  __global const DeviceMaterial* m = s.materials + t.material;
  const float w = 1.0f - u - v;
  float4 color = (float4)(vload3(0, m->albedo), m->alphaFactor);
  if (m->texelOffset != PRELIGHT_NO_TEXTURE)
    color *= sampleTexture(s, m, w * s.texCoords[t.vertex[0]] + u * s.texCoords[t.vertex[1]] + v * s.texCoords[t.vertex[2]]);
#ifdef PRELIGHT_VERTEX_COLORS
  color *= w * s.colors[t.vertex[0]] + u * s.colors[t.vertex[1]] + v * s.colors[t.vertex[2]];
#endif
  return color;
}

// False where an alpha mask has a hole. Programs of scenes without masks are built without the test.
bool surfaceIsThere(Surface s, uint triangle, float u, float v) {
#ifdef PRELIGHT_ALPHA_TEST
  const float cutoff = s.materials[materialAt(s, triangle)].alphaCutoff;
  return cutoff < 0.0f || surfaceColor(s, triangle, u, v).w >= cutoff;
#else
  return true;
#endif
}

#endif
