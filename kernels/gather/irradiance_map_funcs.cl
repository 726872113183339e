// Irradiance on the surface, looked up where rays hit it.
#ifndef PRELIGHT_GATHER_IRRADIANCE_MAP_FUNCS_CL
#define PRELIGHT_GATHER_IRRADIANCE_MAP_FUNCS_CL

#include "shared/gather_types.h"

typedef struct IrradianceMap {
  __global const float2* corners;  // [face][3] texels; a face is a triangle's front, or triangleCount + triangle its back
  __global const float4* texels;   // [row][column] irradiance, W/m2; w unused
  int2 size;
  uint triangleCount;
} IrradianceMap;

IrradianceMap irradianceMapOf(__constant const IrradianceMapLayout* layout, __global const IrradianceLine* lines) {
  const IrradianceMap m = {(__global const float2*)(lines + layout->corners),
                           (__global const float4*)(lines + layout->texels),
                           (int2)((int)layout->width, (int)layout->height), layout->triangleCount};
  return m;
}

// Bilinear between the centres of texels; 0 on a face without a place in the map.
float3 irradianceAt(IrradianceMap m, uint triangle, bool front, float u, float v) {
  __global const float2* c = m.corners + 3 * ((size_t)triangle + (front ? 0u : m.triangleCount));
  if (c[0].x < 0.0f) return (float3)(0.0f);
  const float2 at = (1.0f - u - v) * c[0] + u * c[1] + v * c[2] - 0.5f;
  const float2 base = floor(at), f = at - base;
  const int2 low = clamp(convert_int2(base), (int2)(0), m.size - 1), high = min(low + 1, m.size - 1);
  const float4 upper = mix(m.texels[(size_t)low.y * m.size.x + low.x], m.texels[(size_t)low.y * m.size.x + high.x], f.x);
  const float4 lower = mix(m.texels[(size_t)high.y * m.size.x + low.x], m.texels[(size_t)high.y * m.size.x + high.x], f.x);
  return mix(upper, lower, f.y).xyz;
}

#endif
