// A point of the surface that a ray has met: all that is known of it is found once, when it is loaded.
// Options: PRELIGHT_BUMPS (some material has a normal texture), PRELIGHT_ANISOTROPY (some is anisotropic), those of the surface (transport/alpha_funcs.cl).
#ifndef PRELIGHT_TRANSPORT_INTERACTION_FUNCS_CL
#define PRELIGHT_TRANSPORT_INTERACTION_FUNCS_CL

#include "transport/alpha_funcs.cl"
#include "core/inline.h"
#include "core/octahedral_funcs.cl"
#include "core/offset_funcs.cl"
#include "core/vector_funcs.cl"
#include "shared/ray_types.h"
#include "shared/shade_types.h"

typedef struct PathScene {
  Surface surface;  // its materials hold base colours
  __global const float* vertices;  // [vertex][6] position, normal
  __global const uchar* flat;      // [stored triangle] 1: no shading normals
  __global const uint* tangents;   // [triangle][corner] packDirection() but for bit 16: 1 where the texture is mirrored
  __global const ShadeMaterial* materials;
  __global const float4* albedos;  // of rough lobes, see transport/albedo_table_funcs.cl
  __global const float* measured;  // materials, see transport/measured_funcs.cl
} PathScene;

typedef struct Interaction {
  float3 position;
  float3 error;      // bound of the position's rounding
  float3 wo;         // unit, back along the ray
  float3 geometric;  // unit normal of the triangle, on the side that the ray came from
  Frame frame;       // around the shading normal, z, on the same side
#ifdef PRELIGHT_BUMPS
  float3 body;       // unit, the shading normal as bumps have it, which the frame's turns to the eye: of what scatters diffusely
#endif
#ifdef PRELIGHT_ANISOTROPY
  bool stretched;    // its x is the way in which the surface is rougher; else there is none
#endif
  float3 woLocal;    // wo in the frame
  bool front;
  uint triangle;
  uint material;
  uint flags;  // of the material: PRELIGHT_SOLID | ...
  float u, v;
} Interaction;

PRELIGHT_INLINE float3 vertexPosition(PathScene s, uint vertex) { return vload3(0, s.vertices + 6 * (size_t)vertex); }

// Unit normal of the triangle's front.
PRELIGHT_INLINE float3 frontNormal(float3 a, float3 b, float3 c) {
  const float3 e = b - a, f = c - a;
  const float scale = 1.0f / fmax(fmax(largest(fabs(e)), largest(fabs(f))), 1e-36f);
  return normalize(cross(e * scale, f * scale));
}

// Shading normal on the front side; the geometric one where the file has none or it vanishes.
PRELIGHT_INLINE float3 shadingNormal(PathScene s, uint triangle, float u, float v, float3 front) {
  if (s.flat[storedTriangle(s.surface, triangle).index] != 0) return front;
  const DeviceTriangle t = triangleAt(s.surface, triangle);
  const float3 n = (1.0f - u - v) * vload3(0, s.vertices + 6 * (size_t)t.vertex[0] + 3) +
                   u * vload3(0, s.vertices + 6 * (size_t)t.vertex[1] + 3) +
                   v * vload3(0, s.vertices + 6 * (size_t)t.vertex[2] + 3);
  const float square = dot(n, n);
  if (!(square > 1e-12f)) return front;
  const float3 unit = n * rsqrt(square);
  return dot(unit, front) < 0.0f ? -unit : unit;
}

#if defined(PRELIGHT_BUMPS) || defined(PRELIGHT_ANISOTROPY)
// Directions along and across the texture's u at a point whose normal, without bumps, is n of the front (glTF 2.0, 3.9.3).
// False: the surface has none.
PRELIGHT_INLINE bool tangentsAt(PathScene s, uint triangle, float u, float v, float3 n, float3* x, float3* y) {
  __global const uint* corners = s.tangents + 3 * (size_t)triangle;
  const float3 tangent = (1.0f - u - v) * unpackDirection(corners[0]) + u * unpackDirection(corners[1]) + v * unpackDirection(corners[2]);
  const float3 along = tangent - dot(tangent, n) * n;
  const float square = dot(along, along);
  if (!(square > 1e-12f)) return false;
  *x = along * rsqrt(square);
  *y = (corners[0] & 0x10000u) != 0u ? -cross(n, *x) : cross(n, *x);
  return true;
}
#endif

#ifdef PRELIGHT_ANISOTROPY
// The frame around a shading normal whose x is the way in which an anisotropic material is rougher (KHR_materials_anisotropy).
// n: the normal of the front without bumps. stretched: whether there is such a way.
PRELIGHT_INLINE Frame anisotropicFrame(PathScene s, uint triangle, float u, float v, float3 n, float3 shading, bool* stretched) {
  *stretched = false;
  const DeviceTriangle t = s.surface.triangles[storedTriangle(s.surface, triangle).index];
  __global const ShadeMaterial* m = s.materials + t.material;
  float3 x, y;
  if (!(m->anisotropy > 0.0f) || !tangentsAt(s, triangle, u, v, n, &x, &y)) return frameAround(shading);
  float2 way = (float2)(1.0f, 0.0f);
  const uint texture = m->textures[PRELIGHT_ANISOTROPY_TEXTURE];
  if (texture != PRELIGHT_NO_TEXTURE) way = 2.0f * textureAt(s.surface, texture, t, u, v).xy - 1.0f;
  if (dot(way, way) < 1e-4f) return frameAround(shading);  // no byte tells 0 exactly
  const float2 turn = vload2(0, m->anisotropyTurn);
  const float3 along = (turn.x * way.x - turn.y * way.y) * x + (turn.y * way.x + turn.x * way.y) * y;
  const float3 inPlane = along - dot(along, shading) * shading;
  const float square = dot(inPlane, inPlane);
  if (!(square > 1e-9f)) return frameAround(shading);
  Frame frame;
  frame.x = inPlane * rsqrt(square);
  frame.y = cross(shading, frame.x);
  frame.z = shading;
  *stretched = true;
  return frame;
}
#endif

#ifdef PRELIGHT_BUMPS
// How far a direction that is mirrored about a bumped normal must stay above the triangle, at most.
#define PRELIGHT_LEAST_RISE 0.01f

// The normal n of the front where a texture of normals, or PRELIGHT_NO_TEXTURE, turns it (glTF 2.0, 3.9.3).
PRELIGHT_INLINE float3 bumpedNormal(PathScene s, uint texture, float scale, uint triangle, float u, float v, float3 n) {
  const DeviceTriangle t = s.surface.triangles[storedTriangle(s.surface, triangle).index];
  if (texture == PRELIGHT_NO_TEXTURE) return n;
  const float3 texel = 2.0f * textureAt(s.surface, texture, t, u, v).xyz - 1.0f;
  float3 x, y;
  if (!tangentsAt(s, triangle, u, v, n, &x, &y)) return n;
  const float3 bumped = scale * (texel.x * x + texel.y * y) + texel.z * n;
  const float length2 = dot(bumped, bumped);
  return length2 > 1e-12f ? bumped * rsqrt(length2) : n;
}

// The normal nearest to n, between it and the triangle's own, about which wo is mirrored to above the triangle: where a bump
// is hidden from the eye, its nearest visible slope reflects specularly instead of nothing. With angles from the triangle's normal in the plane
// of both, wo's part in it at p: the mirrored direction is at 2a - p and rises r cos(2a - p), r the length of that part.
PRELIGHT_INLINE float3 visibleNormal(float3 n, float3 geometric, float3 wo) {
  const float rise = dot(wo, geometric), least = fmin(PRELIGHT_LEAST_RISE, 0.9f * rise);
  if (!(rise > 0.0f) || (dot(n, wo) > 0.0f && dot(2.0f * dot(n, wo) * n - wo, geometric) >= least)) return n;
  const float3 side = n - dot(n, geometric) * geometric;
  const float square = dot(side, side);
  if (!(square > 1e-12f)) return geometric;
  const float3 x = side * rsqrt(square);
  const float along = dot(wo, x), r = sqrt(along * along + rise * rise);
  const float angle = 0.5f * (atan2(along, rise) + acos(fmin(least / r, 1.0f)));
  return normalize(sin(angle) * x + cos(angle) * geometric);
}
#endif

PRELIGHT_INLINE Interaction loadInteraction(PathScene s, Ray ray, Hit hit) {
  const DeviceTriangle t = triangleAt(s.surface, hit.triangle);
  const float3 a = vertexPosition(s, t.vertex[0]), b = vertexPosition(s, t.vertex[1]), c = vertexPosition(s, t.vertex[2]);
  Interaction i;
  i.triangle = hit.triangle;
  i.material = t.material;
  i.flags = s.materials[t.material].flags;
  i.u = hit.u;
  i.v = hit.v;
  i.position = pointOnTriangle(a, b, c, hit.u, hit.v);
  i.error = pointError(a, b, c, hit.u, hit.v);
  i.wo = -vload3(0, ray.direction);
  const float3 front = frontNormal(a, b, c);
  float3 shading = shadingNormal(s, hit.triangle, hit.u, hit.v, front);
#ifdef PRELIGHT_ANISOTROPY
  const float3 even = shading;
#endif
  i.front = dot(i.wo, front) >= 0.0f;
  i.geometric = i.front ? front : -front;
#ifdef PRELIGHT_BUMPS
  const uint bumps = s.materials[t.material].textures[PRELIGHT_NORMAL_TEXTURE];
  i.body = i.front ? shading : -shading;
  if (bumps != PRELIGHT_NO_TEXTURE) {
    const float3 bumped = bumpedNormal(s, bumps, s.materials[t.material].normalScale, hit.triangle, hit.u, hit.v, shading);
    i.body = i.front ? bumped : -bumped;
    shading = visibleNormal(i.body, i.geometric, i.wo);
    if (!i.front) shading = -shading;
  }
#endif
#ifdef PRELIGHT_ANISOTROPY
  i.frame = anisotropicFrame(s, hit.triangle, hit.u, hit.v, even, i.front ? shading : -shading, &i.stretched);
#else
  i.frame = frameAround(i.front ? shading : -shading);
#endif
  i.woLocal = toFrame(i.frame, i.wo);
  return i;
}

PRELIGHT_INLINE bool isSolid(Interaction i) { return (i.flags & PRELIGHT_SOLID) != 0u; }

// A ray that leaves the surface.
PRELIGHT_INLINE Ray rayFrom(Interaction i, float3 direction, float tMax) {
  Ray ray;
  vstore3(offsetOrigin(i.position, i.error, i.geometric, direction), 0, ray.origin);
  ray.sourceTriangle = i.triangle;  // a straight ray meets its plane but once
  vstore3(direction, 0, ray.direction);
  ray.tMax = tMax;
  return ray;
}

// A ray that leaves in a direction to meet what is in the way of a target there, but for the last share of the way: the target's
// own triangle, whose distance is subject to rounding, must not count.
PRELIGHT_INLINE Ray rayTo(Interaction i, float3 direction, float3 target, float reach) {
  Ray ray = rayFrom(i, direction, 0.0f);
  const float3 way = target - vload3(0, ray.origin);
  if (!(dot(way, direction) > 0.0f)) return ray;  // rounding has carried the origin beyond the target
  vstore3(way, 0, ray.direction);
  ray.tMax = reach;
  return ray;
}

#endif
