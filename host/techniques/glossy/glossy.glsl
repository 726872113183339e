// Reflection of what arrives at a surface through glossy transfer; needs frame.glsl, scattering.glsl and
// triangles.glsl.
#include "core/dialect.h"
uniform int glossyOrder;
uniform int lobeIsBrdf;          // 1: the lobe is the BRDF over F0 (Phong), 0: the split-sum reflectance's shape
uniform int lampsInLobes;        // 1: lamps that come through the transfer are not in `arriving`, and lobes show them as such
uniform TEXELS arriving;  // [vertex][i] RGB: SH of radiance x visibility x cosine / pi
uniform TEXELS lobes;     // [step][band or share], LobeTable of specular_lobes.h
uniform int measured;            // number of the surface's measured material; < 0: it has none
uniform TEXELS measuredLobes;  // [number][step][axis][band] RGB of measured_lobes.h

const int maxGlossyOrder = 8;
const int lobeSteps = 65;
const int measuredSteps = 33;

vec3 arrivingNumber(ivec3 rows, vec3 weights, int i) {
  return weights.x * FETCH(arriving, rows.x + i).rgb + weights.y * FETCH(arriving, rows.y + i).rgb +
         weights.z * FETCH(arriving, rows.z + i).rgb;
}

vec2 lobeAt(float roughness, int band) {
  float step = clamp(roughness, 0.0, 1.0) * float(lobeSteps - 1);
  int lower = min(int(step), lobeSteps - 2);
  int stride = glossyOrder + 1;
  return mix(FETCH(lobes, lower * stride + band).xy, FETCH(lobes, (lower + 1) * stride + band).xy, step - float(lower));
}

// Share of a lobe of a roughness that is reflected through the transfer.
float shareThroughTransfer(float roughness) {
  if (reflectionRule == reflectionThroughTransfer) return lobeAt(roughness, glossyOrder).y;
  return 0.0;
}

// Shares of the lobes of a body and its coat.
vec2 shareThroughTransfer(vec2 roughness) { return vec2(shareThroughTransfer(roughness.x), shareThroughTransfer(roughness.y)); }

// Sum over coefficients of what arrives, times a factor a band, in the direction w.
vec3 arrivingAbout(ivec3 rows, vec3 weights, vec3 w, vec3 factors[maxGlossyOrder]) {
  vec3 sum = vec3(0.0);
  float real = 1.0;
  float imaginary = 0.0;
  float sectoral = 0.282094792;  // sqrt(1 / (4 pi))
  for (int k = 0; k < glossyOrder; ++k) {
    if (k > 0) {
      float next = real * w.x - imaginary * w.y;
      imaginary = imaginary * w.x + real * w.y;
      real = next;
      sectoral *= sqrt(float(2 * k + 1) / float(2 * k));
    }
    float before = 0.0;
    float p = k > 0 ? 1.41421356 * sectoral : sectoral;
    for (int l = k; l < glossyOrder; ++l) {
      if (l > k) {
        float a = sqrt(float(4 * l * l - 1) / float(l * l - k * k));
        float b = l > 1 ? sqrt(float((l - 1) * (l - 1) - k * k) / float(4 * (l - 1) * (l - 1) - 1)) : 0.0;
        float next = a * (w.z * p - b * before);
        before = p;
        p = next;
      }
      vec3 band = real * arrivingNumber(rows, weights, l * (l + 1) + k);
      if (k > 0) band += imaginary * arrivingNumber(rows, weights, l * (l + 1) - k);
      sum += factors[l] * p * band;
    }
  }
  return sum;
}

// A measured material: its lobe is a sum of zonal ones about axes in the plane of the view.
vec3 reflectMeasured(int triangle, vec3 point, vec3 n, vec3 toEye) {
  ivec3 corners = ivec3(FETCH(triangleCorners, triangle).xyz);
  vec3 weights = weightsOfCorners(corners, point);
  ivec3 rows = corners * (glossyOrder * glossyOrder);
  float cosine = clamp(dot(n, toEye), 0.0, 1.0);
  vec3 across = toEye - dot(n, toEye) * n;
  vec3 side = abs(n.z) < 0.7 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  vec3 x = dot(across, across) > 1e-9 ? normalize(across) : normalize(cross(n, side));
  float place = cosine * float(measuredSteps - 1);
  int lower = min(int(place), measuredSteps - 2);
  int size = glossyOrder * glossyOrder;
  int first = (measured * measuredSteps + lower) * size;
  vec3 sum = vec3(0.0);
  for (int axis = 0; axis < glossyOrder; ++axis) {
    vec3 factors[maxGlossyOrder];
    for (int l = 0; l < glossyOrder; ++l) {
      int at = first + axis * glossyOrder + l;
      factors[l] = mix(FETCH(measuredLobes, at).rgb, FETCH(measuredLobes, at + size).rgb, place - float(lower));
    }
    float angle = pi * ((float(axis) + 0.5) / float(glossyOrder) - 0.5);
    sum += arrivingAbout(rows, weights, sin(angle) * x + cos(angle) * n, factors);
  }
  return max(sum, vec3(0.0));
}

// Returns the radiance that a lobe of a roughness about n reflects of the transferred light. reflectance: of an even sky or,
// with lobeIsBrdf, along the normal.
vec3 reflectThroughTransfer(vec3 reflectance, float roughness, int triangle, vec3 point, vec3 n, vec3 toEye) {
  ivec3 corners = ivec3(FETCH(triangleCorners, triangle).xyz);
  vec3 weights = weightsOfCorners(corners, point);
  ivec3 rows = corners * (glossyOrder * glossyOrder);
  vec3 w = reflect(-toEye, n);
  float cosine = dot(n, w);

  // What an open surface under an even sky of 1 would get: bands of Legendre polynomials.
  vec3 factors[maxGlossyOrder];
  float open = 0.0;
  float legendreBefore = 0.0;
  float legendre = 1.0;
  for (int l = 0; l < glossyOrder; ++l) {
    if (l > 0) {
      float next = (float(2 * l - 1) * cosine * legendre - float(l - 1) * legendreBefore) / float(l);
      legendreBefore = legendre;
      legendre = next;
    }
    vec2 lobe = lobeAt(roughness, l);
    factors[l] = vec3(lobe.x);
    open += lobe.y * legendre;
  }

  vec3 sum = arrivingAbout(rows, weights, w, factors);
  if (lobeIsBrdf != 0) return max(reflectance * pi * sum, vec3(0.0));
  return max(reflectance * sum / max(open, 1e-6), vec3(0.0));
}
