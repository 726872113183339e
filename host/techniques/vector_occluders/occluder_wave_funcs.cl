// Effects that move directions and lights over time (Sherif 2013, 7.3), in OpenCL C and in GLSL: one look-up in a table
// that is periodic in both phases (host/occluders/wave_table.h).
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_WAVE_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_WAVE_FUNCS_CL

#include "techniques/vector_occluders/occluder_math_funcs.cl"
#include "shared/occluder_light_types.h"

#define WAVE_SIDE 64

// Returns the table at two phases in periods, bilinear: displacement (xyz), flicker (w).
vec4 waveAt(TEXELS table, float first, float second) {
  float x = (first - floor(first)) * TO_FLOAT(WAVE_SIDE);
  float y = (second - floor(second)) * TO_FLOAT(WAVE_SIDE);
  int column = min(TO_INT(x), WAVE_SIDE - 1);
  int row = min(TO_INT(y), WAVE_SIDE - 1);
  int right = (column + 1) % WAVE_SIDE;
  int below = (row + 1) % WAVE_SIDE;
  float fx = x - TO_FLOAT(column);
  vec4 upper = mix(FETCH(table, row * WAVE_SIDE + column), FETCH(table, row * WAVE_SIDE + right), fx);
  vec4 lower = mix(FETCH(table, below * WAVE_SIDE + column), FETCH(table, below * WAVE_SIDE + right), fx);
  return mix(upper, lower, y - TO_FLOAT(row));
}

// Returns the displacement of a place by a train of waves along two oblique axes, with one and two periods over time.
vec3 displacementAt(TEXELS table, vec3 place, OccluderTerms terms) {
  float first = terms.waveNumber * dot(place, VEC3(0.8f, 0.2f, 0.565685425f));
  float second = terms.waveNumber * dot(place, VEC3(-0.5f, 0.3f, 0.812403840f));
  return waveAt(table, first + terms.moment, second + 2.0f * terms.moment).xyz;
}

// Turns a unit direction towards a displacement. A zero direction stays zero, and without an amplitude nothing changes.
vec3 bentBy(vec3 direction, vec3 displacement, float amplitude) {
  if (dot(direction, direction) < 0.5f || amplitude <= 0.0f) return direction;
  vec3 across = displacement - dot(displacement, direction) * direction;
  return unitOf(direction + amplitude * across);
}

// Returns the flicker factor of a light's colour: a fire that sinks turns red.
vec3 flickerOf(TEXELS table, int light, OccluderTerms terms) {
  float first = 0.618033989f * TO_FLOAT(light % 64);
  float second = 0.381966011f * TO_FLOAT(light % 64);
  float wave = waveAt(table, first + 3.0f * terms.moment, second + 5.0f * terms.moment).w;
  float strength = max(1.0f + terms.fire * wave, 0.0f);
  return strength * VEC3(1.0f, mix(1.0f, min(strength, 1.0f), 0.4f), mix(1.0f, min(strength, 1.0f), 0.8f));
}

#endif
