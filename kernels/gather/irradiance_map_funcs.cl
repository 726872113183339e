// Irradiance maps of surfaces, looked up where rays hit.
#ifndef PRELIGHT_GATHER_IRRADIANCE_MAP_FUNCS_CL
#define PRELIGHT_GATHER_IRRADIANCE_MAP_FUNCS_CL

#include "shared/density_types.h"
#include "shared/gather_types.h"
#include "shared/walled_square.h"

// An irradiance map in its buffers.
typedef struct IrradianceMap {
  __global const float2* corners;  // [face][3] texels; a face is a triangle's front, or triangleCount + triangle its back
  __global const float4* texels;   // [row][column] irradiance, W/m2; w: 1 inside an object, else 0
  __global const float2* walls;    // [row][column] LightMapLayout::Wall to the right and below; only with `walled`
  // [row][column] 1 + the patch that a texel lies on (host/gi/surface_patches.h); only with `walled`.
  __global const uint* patches;
  int2 size;
  uint triangleCount;
  bool walled;
} IrradianceMap;

IrradianceMap irradianceMapOf(__constant const IrradianceMapLayout* layout, __global const IrradianceLine* lines) {
  const IrradianceMap m = {(__global const float2*)(lines + layout->corners),
                           (__global const float4*)(lines + layout->texels),
                           (__global const float2*)(lines + layout->walls),
                           (__global const uint*)(lines + layout->patches),
                           (int2)((int)layout->width, (int)layout->height), layout->triangleCount,
                           layout->walled != 0u};
  return m;
}

// The four texels between which a look-up interpolates.
typedef struct IrradiancePlace {
  int2 low, high;
  float2 share;  // weight of `high` per axis
} IrradiancePlace;

// Finds the texels around a hit. Returns false for a face without a place in the map.
bool findIrradiancePlace(IrradianceMap m, uint triangle, bool front, float u, float v, IrradiancePlace* place) {
  __global const float2* c = m.corners + 3 * ((size_t)triangle + (front ? 0u : m.triangleCount));
  if (c[0].x < 0.0f) return false;
  const float2 at = (1.0f - u - v) * c[0] + u * c[1] + v * c[2] - 0.5f;
  const float2 base = floor(at);
  place->share = at - base;
  place->low = clamp(convert_int2(base), (int2)(0), m.size - 1);
  place->high = min(place->low + 1, m.size - 1);
  return true;
}

WalledSquare wallsAround(IrradianceMap m, IrradiancePlace p) {
  const float2 first = m.walls[(size_t)p.low.y * m.size.x + p.low.x];
  const WalledSquare w = {first.x, m.walls[(size_t)p.high.y * m.size.x + p.low.x].x, first.y,
                          m.walls[(size_t)p.low.y * m.size.x + p.high.x].y};
  return w;
}

// Returns the light of four texels under one of two weightings; w is 1 for texels inside objects. The weighting with less
// weight inside objects is taken, as their light does not reach the outside; if both have the same, the darker one is.
float3 lightOfSide(float4 lowLow, float4 highLow, float4 lowHigh, float4 highHigh, SquareWeights a, SquareWeights b) {
  const float3 luminance = (float3)(0.2126f, 0.7152f, 0.0722f);
  const float4 first = a.leftTop * lowLow + a.rightTop * highLow + a.leftBottom * lowHigh + a.rightBottom * highHigh;
  const float4 second = b.leftTop * lowLow + b.rightTop * highLow + b.leftBottom * lowHigh + b.rightBottom * highHigh;
  if (fabs(first.w - second.w) > 1e-3f) return first.w < second.w ? first.xyz : second.xyz;
  return dot(second.xyz, luminance) < dot(first.xyz, luminance) ? second.xyz : first.xyz;
}

// Returns the irradiance, W/m2, interpolated bilinearly between the centres of texels that no wall parts; 0 for a face
// without a place in the map.
float3 irradianceAt(IrradianceMap m, uint triangle, bool front, float u, float v) {
  IrradiancePlace p;
  if (!findIrradiancePlace(m, triangle, front, u, v, &p)) return (float3)(0.0f);
  const float4 lowLow = m.texels[(size_t)p.low.y * m.size.x + p.low.x],
               highLow = m.texels[(size_t)p.low.y * m.size.x + p.high.x],
               lowHigh = m.texels[(size_t)p.high.y * m.size.x + p.low.x],
               highHigh = m.texels[(size_t)p.high.y * m.size.x + p.high.x];
  if (m.walled) {
    const WalledSquare w = wallsAround(m, p);
    if (hasWalls(w))
      return lightOfSide(lowLow, highLow, lowHigh, highHigh, walledWeights(w, p.share.x, p.share.y, true),
                     walledWeights(w, p.share.x, p.share.y, false));
  }
  return mix(mix(lowLow, highLow, p.share.x), mix(lowHigh, highHigh, p.share.x), p.share.y).xyz;
}

// Returns the patch of a point's side, as in DensityQuery, or PRELIGHT_WHOLE_REGION where photons are sorted by region.
uint patchAt(IrradianceMap m, uint triangle, bool front, float u, float v) {
  IrradiancePlace p;
  if (!m.walled || !findIrradiancePlace(m, triangle, front, u, v, &p)) return PRELIGHT_WHOLE_REGION;
  const SquareWeights w = walledWeights(wallsAround(m, p), p.share.x, p.share.y, false);
  const bool right = fmax(w.rightTop, w.rightBottom) > fmax(w.leftTop, w.leftBottom);
  const bool below = right ? w.rightBottom > w.rightTop : w.leftBottom > w.leftTop;
  return m.patches[(size_t)(below ? p.high.y : p.low.y) * m.size.x + (right ? p.high.x : p.low.x)];
}

#endif
