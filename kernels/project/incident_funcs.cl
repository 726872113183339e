// Incident light at a place, for surfaces with normal maps: irradiance, and incident radiance in SH.
// Options: PRELIGHT_INCIDENT_ORDER, bands of this SH (default 2).
#ifndef PRELIGHT_PROJECT_INCIDENT_FUNCS_CL
#define PRELIGHT_PROJECT_INCIDENT_FUNCS_CL

#include "project/sh_polynomial_funcs.cl"

#ifndef PRELIGHT_INCIDENT_ORDER
#define PRELIGHT_INCIDENT_ORDER 2
#endif

// Values per channel: irradiance, W/m2, then l0m0, l1m-1, l1m0, l1m1, ...
#define PRELIGHT_INCIDENT_VALUES (1u + PRELIGHT_INCIDENT_ORDER * PRELIGHT_INCIDENT_ORDER)

// 1 / cosine has no bound: light nearer to the horizon counts as if it came from this cosine.
#define PRELIGHT_LEAST_COSINE 0.00390625f

float inverseCosine(float3 direction, float3 normal) {
  return 1.0f / fmax(dot(direction, normal), PRELIGHT_LEAST_COSINE);
}

// Writes the amount that light of irradiance 1 from a unit direction adds to each value; `inverse`: 1 / its cosine.
void incidentValues(float3 direction, float inverse, float* values) {
  const float linear = 0.488602512f * inverse;  // sqrt(3 / (4 pi))
  values[0] = 1.0f;
  values[1] = 0.282094792f * inverse;  // sqrt(1 / (4 pi))
  values[2] = linear * direction.y;
  values[3] = linear * direction.z;
  values[4] = linear * direction.x;
#if PRELIGHT_INCIDENT_ORDER > 2
  higherSh(direction, inverse, PRELIGHT_INCIDENT_ORDER, values + 5);
#endif
}

// Adds light of `irradiance`, W/m2, from a direction to sums [value].
void addIncident(float3 irradiance, float3 direction, float inverse, float3* sums) {
  float values[PRELIGHT_INCIDENT_VALUES];
  incidentValues(direction, inverse, values);
  for (uint i = 0; i < PRELIGHT_INCIDENT_VALUES; ++i) sums[i] += values[i] * irradiance;
}

// Writes the scaled sums [value] to out [channel][value].
void storeIncident(const float3* sums, float scale, __global float* out) {
  for (uint i = 0; i < PRELIGHT_INCIDENT_VALUES; ++i) {
    out[i] = scale * sums[i].x;
    out[PRELIGHT_INCIDENT_VALUES + i] = scale * sums[i].y;
    out[2u * PRELIGHT_INCIDENT_VALUES + i] = scale * sums[i].z;
  }
}

#endif
