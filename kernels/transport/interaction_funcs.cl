// A point of the surface that a ray has met, with all attributes computed once when it is loaded.
// Options: PRELIGHT_BUMPS (some material has a normal texture), PRELIGHT_ANISOTROPY (some is anisotropic), those of the
// surface (transport/alpha_funcs.cl).
#ifndef PRELIGHT_TRANSPORT_INTERACTION_FUNCS_CL
#define PRELIGHT_TRANSPORT_INTERACTION_FUNCS_CL

#include "transport/alpha_funcs.cl"
#include "core/inline.h"
#include "core/octahedral_funcs.cl"
#include "core/offset_funcs.cl"
#include "core/vector_funcs.cl"
#include "shared/ray_types.h"
#include "shared/shade_types.h"

// A scene's surface with everything that shading needs, in its buffers.
typedef struct PathScene {
  Surface surface;  // its materials hold base colours
  __global const float* vertices;  // [vertex][6] position, normal
  __global const uchar* flat;      // [stored triangle] 1 where there are no shading normals
  // [triangle][corner] packDirection() except for bit 16: 1 where the texture is mirrored.
  __global const uint* tangents;
  __global const ShadeMaterial* materials;
  __global const float4* albedos;  // albedos of rough lobes, see transport/albedo_table_funcs.cl
  __global const float* measured;  // tables of measured materials, see transport/measured_funcs.cl
} PathScene;

// A point of the surface that a ray has met.
typedef struct Interaction {
  float3 position;
  float3 error;      // bound of the position's rounding
  float3 wo;         // unit, back along the ray
  float3 geometric;  // unit normal of the triangle, on the side that the ray came from
  Frame frame;       // around the shading normal, z, on the same side
#ifdef PRELIGHT_BUMPS
  // Unit shading normal with bumps, for diffuse scattering; the frame's normal is turned towards the eye instead.
  float3 body;
#endif
#ifdef PRELIGHT_ANISOTROPY
  bool stretched;    // its x is the direction in which the surface is rougher; otherwise there is none
#endif
  float3 woLocal;    // wo in the frame
  bool front;
  uint triangle;
  uint material;
  uint flags;  // flags of the material: PRELIGHT_SOLID | ...
  float u, v;
} Interaction;

PRELIGHT_INLINE float3 vertexPosition(PathScene s, uint vertex) { return vload3(0, s.vertices + 6 * (size_t)vertex); }

// Returns the unit normal of the triangle's front.
PRELIGHT_INLINE float3 frontNormal(float3 a, float3 b, float3 c) {
  const float3 e = b - a, f = c - a;
  const float scale = 1.0f / fmax(fmax(largest(fabs(e)), largest(fabs(f))), 1e-36f);
  return normalize(cross(e * scale, f * scale));
}

// Returns the shading normal on the front side; the geometric one where the file has none or it vanishes.
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
// Writes the directions along and across the texture's u at a point whose normal, without bumps, is n of the front
// (glTF 2.0, 3.9.3). Returns false when the surface has none.
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
// Returns the frame around a shading normal whose x is the direction in which an anisotropic material is rougher
// (KHR_materials_anisotropy). n: the normal of the front without bumps. stretched: set to true when there is such a
// direction.
PRELIGHT_INLINE Frame anisotropicFrame(PathScene s, uint triangle, float u, float v, float3 n, float3 shading, bool* stretched) {
  *stretched = false;
  const DeviceTriangle t = s.surface.triangles[storedTriangle(s.surface, triangle).index];
  __global const ShadeMaterial* m = s.materials + t.material;
  float3 x, y;
  if (!(m->anisotropy > 0.0f) || !tangentsAt(s, triangle, u, v, n, &x, &y)) return frameAround(shading);
  float2 way = (float2)(1.0f, 0.0f);
  const uint texture = m->textures[PRELIGHT_ANISOTROPY_TEXTURE];
  if (texture != PRELIGHT_NO_TEXTURE) way = 2.0f * textureAt(s.surface, texture, t, u, v).xy - 1.0f;
  if (dot(way, way) < 1e-4f) return frameAround(shading);  // no byte value represents 0 exactly
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
// Greatest height above the triangle that a direction mirrored about a bumped normal must keep.
#define PRELIGHT_LEAST_RISE 0.01f

// Returns the front's normal n as turned by a normal texture, unless that is PRELIGHT_NO_TEXTURE (glTF 2.0, 3.9.3).
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

// Returns the normal nearest to n, between it and the triangle's own, about which wo is mirrored to above the triangle:
// where a bump is hidden from the eye, its nearest visible slope reflects specularly instead of nothing. With angles
// measured from the triangle's normal in the plane of both normals, where wo's part lies at angle p and has length r, a
// normal at angle a mirrors it to 2a - p, which rises r cos(2a - p).
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

// Returns a ray that leaves the surface.
PRELIGHT_INLINE Ray rayFrom(Interaction i, float3 direction, float tMax) {
  Ray ray;
  vstore3(offsetOrigin(i.position, i.error, i.geometric, direction), 0, ray.origin);
  ray.sourceTriangle = i.triangle;  // a straight ray meets the plane of its triangle only once
  vstore3(direction, 0, ray.direction);
  ray.tMax = tMax;
  return ray;
}

// Returns a ray that leaves in a direction to test for occluders in front of a target there. It stops before the last
// share of the distance, because the target's own triangle, whose distance is subject to rounding, must not count.
PRELIGHT_INLINE Ray rayTo(Interaction i, float3 direction, float3 target, float reach) {
  Ray ray = rayFrom(i, direction, 0.0f);
  const float3 way = target - vload3(0, ray.origin);
  if (!(dot(way, direction) > 0.0f)) return ray;  // rounding has moved the origin beyond the target
  vstore3(way, 0, ray.direction);
  ray.tMax = reach;
  return ray;
}

#endif
