// Spherical harmonics of one direction, all bands up to order 32, almost as exact as float allows: the Gram error is about
// 2e-7 at order 32. The conventions are those of docs/conventions.md. For sums over many rays at low orders
// project/sh_funcs.cl is faster and exact enough. With the table of CH these functions yield CH.
//
// Losses of digits at high orders, and what is done about them:
// - Rounding in the recurrence grows with the band: Q is carried as a sum of two floats.
// - A direction that is rounded to float is not of length 1, and Y_l changes with the length's l-th power:
//   Q is evaluated as the homogeneous polynomial of degree l - m, which takes b^2 r^2 in the place of b^2, and divided by
//   r^l, with r^2 - 1 computed without error.
// The factors sin^m cos(m phi) are Re and Im of (x + iy)^m (Sloan 2013, JCGT 2(2)).
#ifndef PRELIGHT_BASIS_SH_EVALUATE_FUNCS_CL
#define PRELIGHT_BASIS_SH_EVALUATE_FUNCS_CL

#pragma OPENCL FP_CONTRACT OFF

// Returns a + b without error, as sum and rest (Knuth).
float2 twoSum(float a, float b) {
  const float sum = a + b;
  const float part = sum - a;
  return (float2)(sum, (a - (sum - part)) + (b - part));
}

// Returns x^2 + y^2 + z^2 - 1 of a vector whose length is almost 1.
float excessLength2(float x, float y, float z) {
  const float xx = x * x;
  const float yy = y * y;
  const float zz = z * z;
  const float2 xy = twoSum(xx, yy);
  const float2 xyz = twoSum(xy.x, zz);
  return (xyz.x - 1.0f) + ((xy.y + xyz.y) + (fma(x, x, -xx) + (fma(y, y, -yy) + fma(z, z, -zz))));
}

// Writes values[i stride] = Y_i(x, y, z), i < order^2. table: makeMonicShTable in benchmarks/lab/harmonic_tables.h, [l order + m].
void evaluateShAt(__global const float4* table, int order, float x, float y, float z, int stride,
                  __global float* values) {
  const float excess = excessLength2(x, y, z);
  float cosine = 1.0f;  // sin^m(theta) cos(m phi)
  float sine = 0.0f;
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      const float next = fma(cosine, x, -sine * y);
      sine = fma(sine, x, cosine * y);
      cosine = next;
    }
    float2 before = (float2)(0.0f, 0.0f);
    float2 q = (float2)(1.0f, 0.0f);
    for (int l = m; l < order; ++l) {
      const float4 constants = table[l * order + m];  // b^2, its rest, N, its rest
      if (l > m) {
        const float up = z * q.x;
        const float upRest = fma(z, q.x, -up) + z * q.y;
        const float down = constants.x * before.x;
        const float downRest =
            fma(constants.x, before.x, -down) + constants.y * before.x + constants.x * before.y + excess * down;
        before = q;
        q = twoSum(up, -down);
        q.y += upRest - downRest;
      }
      const float value = constants.z * q.x;
      const float rest = fma(constants.z, q.x, -value) + constants.w * q.x + constants.z * q.y;
      const float p = value + (rest - 0.5f * excess * (float)l * value);
      values[(l * (l + 1) + m) * stride] = p * cosine;
      if (m > 0) values[(l * (l + 1) - m) * stride] = p * sine;
    }
  }
}

#endif
