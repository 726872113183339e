// Wavelengths, their colours, and the index of refraction for them (KHR_materials_dispersion). OpenCL C and GLSL.
#ifndef PRELIGHT_CORE_WAVE_FUNCS_CL
#define PRELIGHT_CORE_WAVE_FUNCS_CL

#include "core/dialect.h"

#define PRELIGHT_SHORTEST_WAVE 430.0f  // nm; pure blue
#define PRELIGHT_LONGEST_WAVE 670.0f   // nm; pure red

// Returns the colour of a wavelength: blue in one half, red in the other, green between them. `part`: position between
// the shortest wavelength (0) and the longest (1). The mean of each channel over all wavelengths is 1.
vec3 colorOfWave(float part) {
  float x = 2.0f * part - 1.0f;
  return VEC3(4.0f * max(x, 0.0f), 2.0f - 2.0f * ABS(x), 4.0f * max(-x, 0.0f));
}

// Returns the index of refraction at a wavelength by Cauchy's equation with Abbe's number 20 / dispersion. `ior`: the
// index at 587.6 nm.
float iorOfWave(float ior, float dispersion, float part) {
  float wave = mix(PRELIGHT_SHORTEST_WAVE, PRELIGHT_LONGEST_WAVE, part);
  return max(ior + (ior - 1.0f) * dispersion * 0.05f * (523655.0f / (wave * wave) - 1.5168f), 1.0f);
}

#endif
