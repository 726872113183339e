// Powers and lobes, in OpenCL C and in GLSL. Powers are computed here because implementations of GLSL differ in theirs
// by more than pictures may differ.
#ifndef PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_MATH_FUNCS_CL
#define PRELIGHT_VECTOR_OCCLUDERS_OCCLUDER_MATH_FUNCS_CL

#include "core/dialect.h"

#define OCCLUDER_PI 3.14159265358979f
#define LOG2_E 1.44269504f

// Returns 2^x to a relative 2e-7, with x clamped to [-126, 126]: a Taylor series around the nearest whole number.
float exp2Of(float x) {
  float bounded = clamp(x, -126.0f, 126.0f);
  float whole = floor(bounded + 0.5f);
  float f = bounded - whole;
  float series =
      1.0f +
      f * (0.693147181f +
           f * (0.240226507f + f * (0.0555041087f + f * (0.00961812911f + f * (0.00133335581f + f * 0.000154035304f)))));
  return series * FLOAT_OF_BITS((TO_INT(whole) + 127) << 23);
}

// Returns the binary logarithm of a positive, normal number to 1e-6: 2 artanh((m - 1) / (m + 1)) / ln 2 for the
// mantissa m.
float log2Of(float x) {
  int bits = BITS_OF(x);
  float exponent = TO_FLOAT(((bits >> 23) & 255) - 127);
  float mantissa = FLOAT_OF_BITS((bits & 0x007fffff) | 0x3f800000);
  if (mantissa > 1.41421356f) {
    mantissa *= 0.5f;
    exponent += 1.0f;
  }
  float s = (mantissa - 1.0f) / (mantissa + 1.0f);
  float s2 = s * s;
  float series = 2.88539008f + s2 * (0.961796694f + s2 * (0.577078016f + s2 * (0.412198583f + s2 * 0.320598898f)));
  return exponent + s * series;
}

// Returns x^y for x in [0, 1], with 0^0 = 1.
float powerOf(float x, float y) {
  if (x < 1e-30f) return y > 0.0f ? 0.0f : 1.0f;
  return exp2Of(y * log2Of(x));
}

float expOf(float x) { return exp2Of(x * LOG2_E); }

// Returns v normalised, or zero where it has no direction.
vec3 unitOf(vec3 v) {
  float square = dot(v, v);
  return square > 1e-30f ? v * INVERSE_SQRT(square) : VEC3(0.0f);
}

// Returns 1 - cosine between unit vectors without cancellation; 1 where `a` is zero.
float oneMinusCosine(vec3 a, vec3 b) {
  vec3 chord = a - b;
  return dot(a, a) > 0.5f ? 0.5f * dot(chord, chord) : 1.0f;
}

// Returns the mean resultant length, in [0, 1], of a sum of unit vectors with total weight w.
float resultantOf(vec4 sum) {
  float square = dot(sum.xyz, sum.xyz);
  return square > 1e-30f && sum.w > 0.0f ? min(sqrt(square) / sum.w, 1.0f) : 0.0f;
}

// Returns the value of a von Mises-Fisher density at its mean direction, 1/sr.
float vonMisesFisherPeak(float kappa) {
  return kappa / (2.0f * OCCLUDER_PI * (1.0f - expOf(-2.0f * kappa)));
}

// Returns a cosine power whose integral over all directions is 1, 1/sr.
float cosineLobe(float exponent, float cosine) {
  return (exponent + 1.0f) / (2.0f * OCCLUDER_PI) * powerOf(clamp(cosine, 0.0f, 1.0f), exponent);
}

vec3 mirroredAbout(vec3 way, vec3 normal) { return way - 2.0f * dot(way, normal) * normal; }

#endif
