// Conversion of elements' rays into codes of the elements that they hit.
// Options: those of the surface (transport/alpha_funcs.cl).
#include "transport/alpha_funcs.cl"
#include "shared/radiosity_types.h"
#include "shared/ray_types.h"

// Returns the piece, of a triangle cut into n^2, in which (u, v) lies; host/radiosity/elements.h defines the order.
uint pieceAt(uint n, float u, float v) {
  const float x = u * (float)n, y = v * (float)n;
  const uint row = min(n - 1u, (uint)fmax(0.0f, y));
  const uint column = min(n - 1u - row, (uint)fmax(0.0f, x));
  const bool inverted = column + row + 1u < n && (x - (float)column) + (y - (float)row) > 1.0f;
  return row * (2u * n - row) + 2u * column + (inverted ? 1u : 0u);
}

// One work-item per ray. rays, hits [ray]; pieces [triangle] (first piece, splits); normals [triangle][3] of the
// fronts; reflecting [triangle], 1 where a back reflects or lets light through -> codes [ray], the element that was hit
// or PRELIGHT_ESCAPED; marks [triangle] is set to 1 where light comes from a back or through the surface to the front.
__kernel void codeElements(uint count, uint perSide, __global const Ray* rays, __global const Hit* hits,
                           __global const uint2* pieces, __global const float* normals,
                           __global const uchar* reflecting, __global uint* codes, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Hit hit = hits[i];
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
    codes[i] = PRELIGHT_ESCAPED;
    return;
  }
  const bool back = dot(vload3(0, rays[i].direction), vload3(hit.triangle, normals)) > 0.0f;
  const uint2 piece = pieces[hit.triangle];
  codes[i] = piece.x + pieceAt(piece.y, hit.u, hit.v) + (back ? perSide : 0u);
  const uchar reflects = reflecting[hit.triangle];
  if ((back && (reflects & 1)) || (reflects & 2)) marks[hit.triangle] = 1;
}

// One work-item per point of an element, with `raysPerPoint` rays. points [point]; rays, hits [point][ray]; normals
// [triangle][3] of the fronts; twoSided [triangle] -> judged [point]: albedo, and 1 where the point counts. A point
// does not count in a hole of an alpha mask, nor, on a front, where every ray that leaves the surface meets the back of
// a one-sided surface: such a place lies inside an object.
__kernel void judgePoints(uint count, uint raysPerPoint, __constant const SceneLayout* layout,
                          __global const SurfaceLine* surfaceLines, __global const ElementPoint* points,
                          __global const Ray* rays, __global const Hit* hits, __global const float* normals,
                          __global const uchar* twoSided, __global float4* judged) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const ElementPoint point = points[i];
  const Surface surface = surfaceOf(layout, surfaceLines);
  const float3 albedo = clamp(surfaceColor(surface, point.triangle, point.u, point.v).xyz, 0.0f, 1.0f);
  bool there = surfaceIsThere(surface, point.triangle, point.u, point.v);
  if (there && point.back == 0u) {
    bool inside = true;
    for (uint j = 0; inside && j < raysPerPoint; ++j) {
      const size_t ray = i * raysPerPoint + j;
      const uint t = hits[ray].triangle;
      inside = t != PRELIGHT_NO_TRIANGLE && !twoSided[t] && dot(vload3(0, rays[ray].direction), vload3(t, normals)) > 0.0f;
    }
    there = !inside;
  }
  judged[i] = (float4)(albedo, there ? 1.0f : 0.0f);
}
