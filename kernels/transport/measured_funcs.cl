// Measured reflectance beyond its diffuse part, from tables that host/scene/measured_brdf.h makes.
// [1] Rusinkiewicz 1998, "A New Change of Variables for Efficient BRDF Representation".
// [2] Matusik et al. 2003, "A Data-Driven Reflectance Model".
#ifndef PRELIGHT_TRANSPORT_MEASURED_FUNCS_CL
#define PRELIGHT_TRANSPORT_MEASURED_FUNCS_CL

#include "core/inline.h"
#include "shared/measured_types.h"

// Returns the albedo for a direction of this cosine.
PRELIGHT_INLINE float3 measuredAlbedo(__global const float* table, float cosine) {
  const float place = sqrt(clamp(cosine, 0.0f, 1.0f)) * (float)(PRELIGHT_MEASURED_COSINES - 1);
  const int first = min((int)place, PRELIGHT_MEASURED_COSINES - 2);
  return mix(vload3(first, table), vload3(first + 1, table), place - (float)first);
}

// Interpolates between the neighbours of a turn in a row of turns, the last of which is next to the first.
PRELIGHT_INLINE float3 betweenTurns(__global const float* row, float place) {
  const float shifted = place - 0.5f + (float)PRELIGHT_MEASURED_TURNS;
  const int first = (int)shifted;
  return mix(vload3(first % PRELIGHT_MEASURED_TURNS, row), vload3((first + 1) % PRELIGHT_MEASURED_TURNS, row), shifted - (float)first);
}

// Returns the reflectance from wi to wo, 1/sr, in the frame of the shading normal; below 0 where less light leaves than
// the diffuse part sends. The angles are those of [1], the cells those of [2]: values are those of cell centres, and
// are interpolated between them.
PRELIGHT_INLINE float3 measuredRest(__global const float* table, float3 wo, float3 wi) {
  const float3 h = normalize(wo + wi);
  const float across = sqrt(h.x * h.x + h.y * h.y);
  const float2 way = across > 1e-6f ? h.xy / across : (float2)(1.0f, 0.0f);
  const float x = h.z * (wi.x * way.x + wi.y * way.y) - across * wi.z, y = wi.y * way.x - wi.x * way.y, z = dot(wi, h);
  const float halfAngle = sqrt(clamp(atan2pi(across, h.z) * 2.0f, 0.0f, 1.0f)) * (float)PRELIGHT_MEASURED_HALVES;
  const float apart = atan2pi(sqrt(x * x + y * y), z) * (2.0f * (float)PRELIGHT_MEASURED_DIFFERENCES);
  const float turn = atan2pi(y, x), place = (turn - floor(turn)) * (float)PRELIGHT_MEASURED_TURNS;
  const float a = clamp(halfAngle - 0.5f, 0.0f, (float)(PRELIGHT_MEASURED_HALVES - 1));
  const float b = clamp(apart - 0.5f, 0.0f, (float)(PRELIGHT_MEASURED_DIFFERENCES - 1));
  const int i = min((int)a, PRELIGHT_MEASURED_HALVES - 2), j = min((int)b, PRELIGHT_MEASURED_DIFFERENCES - 2);
  const int rowSize = 3 * PRELIGHT_MEASURED_TURNS, rowsOfHalf = rowSize * PRELIGHT_MEASURED_DIFFERENCES;
  __global const float* row = table + 3 * PRELIGHT_MEASURED_COSINES + i * rowsOfHalf + j * rowSize;
  const float3 here = mix(betweenTurns(row, place), betweenTurns(row + rowSize, place), b - (float)j);
  row += rowsOfHalf;
  const float3 next = mix(betweenTurns(row, place), betweenTurns(row + rowSize, place), b - (float)j);
  return mix(here, next, a - (float)i);
}

#endif
