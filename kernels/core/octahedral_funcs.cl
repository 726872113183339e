// Directions in 32 bits, as host/base/directions.h folds them (Meyer et al. 2010; Cigolle et al. 2014).
#ifndef PRELIGHT_CORE_OCTAHEDRAL_FUNCS_CL
#define PRELIGHT_CORE_OCTAHEDRAL_FUNCS_CL

// Returns 1 or -1 per component by its sign; 1 at 0.
float2 octahedralSides(float2 x) { return select((float2)(-1.0f), (float2)(1.0f), isgreaterequal(x, (float2)(0.0f))); }

// Packs a direction, which need not be unit; one without length becomes +Z. The error is at most 6.5e-5.
uint packDirection(float3 direction) {
  const float sum = fabs(direction.x) + fabs(direction.y) + fabs(direction.z);
  float2 place = sum > 0.0f ? direction.xy / sum : (float2)(0.0f);
  if (direction.z < 0.0f) place = (1.0f - fabs(place.yx)) * octahedralSides(place);
  const uint2 steps = convert_uint2_rte(clamp(0.5f * place + 0.5f, 0.0f, 1.0f) * 65535.0f);
  return steps.x | steps.y << 16;
}

// Returns the unit direction that packDirection has packed.
float3 unpackDirection(uint packed) {
  const float2 place = convert_float2((uint2)(packed & 0xffffu, packed >> 16)) * (2.0f / 65535.0f) - 1.0f;
  const float z = 1.0f - fabs(place.x) - fabs(place.y);
  return normalize((float3)(place - octahedralSides(place) * max(-z, 0.0f), z));
}

#endif
