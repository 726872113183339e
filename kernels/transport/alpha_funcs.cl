// Surface attributes at a hit: textures, coverage (alpha masks and blending) and diffuse albedo.
// Options: PRELIGHT_VERTEX_COLORS, PRELIGHT_ALPHA_TEST, PRELIGHT_SHARED_SURFACE, PRELIGHT_ALBEDO_SHARES (some metalness
// or transmission on which the albedo depends has a texture).
#ifndef PRELIGHT_TRANSPORT_ALPHA_FUNCS_CL
#define PRELIGHT_TRANSPORT_ALPHA_FUNCS_CL

#include "core/inline.h"
#include "core/sampling_funcs.cl"
#include "shared/scene_layout_types.h"
#include "shared/scene_types.h"

// The triangles, materials and textures of a scene in their buffers.
typedef struct Surface {
  __global const DeviceTriangle* triangles;   // [stored triangle]
  __global const SurfaceRange* ranges;        // [range]; read only with PRELIGHT_SHARED_SURFACE
  uint rangeCount;
  __global const DeviceMaterial* materials;   // [material]
  __global const DeviceTexture* textures;
  __global const float2* texCoords;           // [stored vertex], first set
  __global const float2* texCoords1;          // [stored vertex], second set; read only where a texture asks for it
  __global const float4* colors;              // [stored vertex], linear; read only with PRELIGHT_VERTEX_COLORS
  __global const ushort4* texels;             // linear RGBA in 1/65535: decoded once, not at every hit
} Surface;

Surface surfaceOf(__constant const SceneLayout* layout, __global const SurfaceLine* surface) {
  const Surface s = {(__global const DeviceTriangle*)(surface + layout->triangles),
                     (__global const SurfaceRange*)(surface + layout->ranges), layout->rangeCount,
                     (__global const DeviceMaterial*)(surface + layout->materials),
                     (__global const DeviceTexture*)(surface + layout->textures),
                     (__global const float2*)(surface + layout->texCoords),
                     (__global const float2*)(surface + layout->texCoords1),
                     (__global const float4*)(surface + layout->colors),
                     (__global const ushort4*)(surface + layout->texels)};
  return s;
}

// The index of a stored triangle, and the shift from its stored vertices to the scene's.
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

// Returns a triangle of the scene with the scene's vertices.
PRELIGHT_INLINE DeviceTriangle triangleAt(Surface s, uint triangle) {
  const StoredTriangle stored = storedTriangle(s, triangle);
  DeviceTriangle t = s.triangles[stored.index];
  for (int corner = 0; corner < 3; ++corner) t.vertex[corner] += stored.vertexShift;
  return t;
}

PRELIGHT_INLINE uint materialAt(Surface s, uint triangle) { return s.triangles[storedTriangle(s, triangle).index].material; }

// Returns texel coordinate i wrapped to [0, size), by integer arithmetic, as glTF samplers do.
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

float4 fetchTexel(Surface s, __global const DeviceTexture* t, int x, int y) {
  const uint at = t->texelOffset + wrapTexel(y, t->height, t->wrapT) * t->width + wrapTexel(x, t->width, t->wrapS);
  return convert_float4(s.texels[at]) * (1.0f / 65535.0f);
}

// Returns linear RGB and alpha at coordinates of the image, bilinear unless the texture says otherwise. Coordinates
// beyond 2^20 texels are folded, so that extreme ones stay valid integers.
float4 sampleTexture(Surface s, __global const DeviceTexture* t, float2 uv) {
  const bool nearest = (t->flags & PRELIGHT_NEAREST) != 0u;
  float2 at = uv * (float2)((float)t->width, (float)t->height) - (nearest ? 0.0f : 0.5f);
  at = fmod(at, 1048576.0f);
  at = select(at, (float2)(0.0f), isnan(at));
  const float2 base = floor(at);
  const float2 f = at - base;
  const int x = (int)base.x, y = (int)base.y;
  if (nearest) return fetchTexel(s, t, x, y);
  return mix(mix(fetchTexel(s, t, x, y), fetchTexel(s, t, x + 1, y), f.x),
             mix(fetchTexel(s, t, x, y + 1), fetchTexel(s, t, x + 1, y + 1), f.x), f.y);
}

// Returns the coordinates of a texture's image at a point of a triangle (with stored vertices).
PRELIGHT_INLINE float2 textureCoord(Surface s, __global const DeviceTexture* t, DeviceTriangle triangle, float u, float v) {
  __global const float2* coords = (t->flags & PRELIGHT_SECOND_SET) != 0u ? s.texCoords1 : s.texCoords;
  const float2 at = (1.0f - u - v) * coords[triangle.vertex[0]] + u * coords[triangle.vertex[1]] + v * coords[triangle.vertex[2]];
  return (float2)(t->u[0] * at.x + t->u[1] * at.y + t->u[2], t->v[0] * at.x + t->v[1] * at.y + t->v[2]);
}

// Returns the texture of this index in the list at a point of a triangle (with stored vertices); white where there is
// none.
PRELIGHT_INLINE float4 textureAt(Surface s, uint texture, DeviceTriangle triangle, float u, float v) {
  if (texture == PRELIGHT_NO_TEXTURE) return (float4)(1.0f);
  __global const DeviceTexture* t = s.textures + texture;
  return sampleTexture(s, t, textureCoord(s, t, triangle, u, v));
}

// Returns factor x texture x vertex colour at a point of a triangle (with stored vertices).
PRELIGHT_INLINE float4 factorAndTexture(Surface s, DeviceTriangle t, float u, float v) {
  __global const DeviceMaterial* m = s.materials + t.material;
  float4 color = (float4)(vload3(0, m->albedo), m->alphaFactor);
  if (m->colorTexture != PRELIGHT_NO_TEXTURE) color *= textureAt(s, m->colorTexture, t, u, v);
#ifdef PRELIGHT_VERTEX_COLORS
  color *= (1.0f - u - v) * s.colors[t.vertex[0]] + u * s.colors[t.vertex[1]] + v * s.colors[t.vertex[2]];
#endif
  return color;
}

// Returns the linear albedo and alpha at a point of a triangle.
PRELIGHT_INLINE float4 surfaceColor(Surface s, uint triangle, float u, float v) {
  const DeviceTriangle t = s.triangles[storedTriangle(s, triangle).index];
  float4 color = factorAndTexture(s, t, u, v);
#ifdef PRELIGHT_ALBEDO_SHARES
  __global const DeviceMaterial* m = s.materials + t.material;
  if (m->metallicTexture != PRELIGHT_NO_TEXTURE) color.xyz *= 1.0f - m->metallic * textureAt(s, m->metallicTexture, t, u, v).z;
  if (m->glassTexture != PRELIGHT_NO_TEXTURE) color.xyz *= 1.0f - m->glass * textureAt(s, m->glassTexture, t, u, v).x;
#endif
  return color;
}

// Returns a number in [0,1) that is the same wherever the same ray meets the same point.
PRELIGHT_INLINE float chanceAt(uint triangle, float u, float v) {
  return unitFloat(hashInteger(hashInteger(as_uint(u) ^ hashInteger(triangle)) ^ as_uint(v)));
}

// Returns the coverage of the surface at a point: 0 in the holes of a mask, alpha on a blended surface. Scenes without
// either use programs without the test.
PRELIGHT_INLINE float surfaceCoverage(Surface s, uint triangle, float u, float v) {
#ifdef PRELIGHT_ALPHA_TEST
  const DeviceTriangle t = s.triangles[storedTriangle(s, triangle).index];
  const float cutoff = s.materials[t.material].alphaCutoff;
  if (cutoff < 0.0f) return 1.0f;
  const float alpha = factorAndTexture(s, t, u, v).w;
  return (s.materials[t.material].flags & PRELIGHT_BLENDED) != 0u ? clamp(alpha, 0.0f, 1.0f) : (alpha >= cutoff ? 1.0f : 0.0f);
#else
  return 1.0f;
#endif
}

// Returns false where a ray passes the surface at a point: in holes, and by chance where it is blended.
bool surfaceIsThere(Surface s, uint triangle, float u, float v) {
#ifdef PRELIGHT_ALPHA_TEST
  const DeviceTriangle t = s.triangles[storedTriangle(s, triangle).index];
  const float cutoff = s.materials[t.material].alphaCutoff;
  if (cutoff < 0.0f) return true;
  const float alpha = factorAndTexture(s, t, u, v).w;
  return (s.materials[t.material].flags & PRELIGHT_BLENDED) != 0u ? alpha > chanceAt(triangle, u, v) : alpha >= cutoff;
#else
  return true;
#endif
}

#endif
