// Wavelengths, their colours, and the index of refraction for them (KHR_materials_dispersion). OpenCL C and GLSL.
#ifndef PRELIGHT_CORE_WAVE_FUNCS_CL
#define PRELIGHT_CORE_WAVE_FUNCS_CL

#include "core/dialect.h"

#define PRELIGHT_SHORTEST_WAVE 430.0f  // nm; blue alone
#define PRELIGHT_LONGEST_WAVE 670.0f   // red alone

// Blue in one half, red in the other, green between them; part: of the way from the shortest wave to the longest. The means over all
// are 1.
vec3 colorOfWave(float part) {
  float x = 2.0f * part - 1.0f;
  return VEC3(4.0f * max(x, 0.0f), 2.0f - 2.0f * ABS(x), 4.0f * max(-x, 0.0f));
}

// Cauchy's equation with Abbe's number 20 / dispersion; ior: that at 587.6 nm.
float iorOfWave(float ior, float dispersion, float part) {
  float wave = mix(PRELIGHT_SHORTEST_WAVE, PRELIGHT_LONGEST_WAVE, part);
  return max(ior + (ior - 1.0f) * dispersion * 0.05f * (523655.0f / (wave * wave) - 1.5168f), 1.0f);
}

#endif
