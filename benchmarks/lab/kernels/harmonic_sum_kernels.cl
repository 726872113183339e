// Sums of harmonics over directions, as a bake projects its rays, by several ways to evaluate them.
// Options: PRELIGHT_SH_ORDER; PRELIGHT_HARMONICS, a way:
//   0  orthonormal, or CH of norm 1: the recurrence of project/sh_funcs.cl, two constants a function
//   1  polynomials whose leading coefficient is 1: one constant a function, and norms behind the sum
//   2  CH alone, without constants: derivatives of T_l = 2 z T_(l-1) - T_(l-2) and norms behind the sum
#include "core/lanes_funcs.cl"
#include "project/sh_funcs.cl"

#define PRELIGHT_HARMONIC_COUNT (PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER)

#if PRELIGHT_HARMONICS == 1

// table [l order + m]: b^2 of Q_l = z Q_(l-1) - b^2 Q_(l-2).
void accumulateHarmonics(__constant const float* table, float8 x, float8 y, float8 z, float8 weight, float8* sum) {
  float8 cosine = weight;  // weight x sin^m(theta) cos(m phi)
  float8 sine = (float8)(0.0f);
#pragma unroll
  for (int m = 0; m < PRELIGHT_SH_ORDER; ++m) {
    if (m > 0) {
      const float8 c = cosine * x - sine * y;
      sine = sine * x + cosine * y;
      cosine = c;
    }
    float8 before = (float8)(0.0f);
    float8 value = (float8)(1.0f);
#pragma unroll
    for (int l = m; l < PRELIGHT_SH_ORDER; ++l) {
      if (l > m) {
        const float8 next = z * value - table[l * PRELIGHT_SH_ORDER + m] * before;
        before = value;
        value = next;
      }
      sum[l * (l + 1) + m] += value * cosine;
      if (m > 0) sum[l * (l + 1) - m] += value * sine;
    }
  }
}

#elif PRELIGHT_HARMONICS == 2

// S_lm, the m-th derivative of T_l over that of T_m, is 2 z S_(l-1)m - S_(l-2)m + S_(l-1)(m-1); S_l0 = 2 T_l.
void accumulateHarmonics(__constant const float* table, float8 x, float8 y, float8 z, float8 weight, float8* sum) {
  const float8 twice = z + z;
  float8 cosine = weight;
  float8 sine = (float8)(0.0f);
  float8 column[PRELIGHT_SH_ORDER];  // [l] of m - 1
#pragma unroll
  for (int m = 0; m < PRELIGHT_SH_ORDER; ++m) {
    if (m > 0) {
      const float8 c = cosine * x - sine * y;
      sine = sine * x + cosine * y;
      cosine = c;
    }
    float8 before = m == 0 ? twice : (float8)(0.0f);
    float8 value = m == 0 ? (float8)(2.0f) : (float8)(1.0f);
    float8 beside = column[m];
#pragma unroll
    for (int l = m; l < PRELIGHT_SH_ORDER; ++l) {
      if (l > m) {
        const float8 step = twice * value - before;
        before = value;
        value = m == 0 ? step : step + beside;
        beside = column[l];
      }
      column[l] = value;
      sum[l * (l + 1) + m] += value * cosine;
      if (m > 0) sum[l * (l + 1) - m] += value * sine;
    }
  }
}

#else
#define accumulateHarmonics accumulateSh
#endif

// A work-item's directions, `groups` times eight of them: directions [item][group][x, y, z, weight][8] -> sums
// [item][order^2], of weight times the function, times norms [order^2].
__kernel void sumHarmonics(uint items, uint groups, __constant const float* table, __constant const float* norms,
                           __global const float* directions, __global float* sums) {
  const size_t item = get_global_id(0);
  if (item >= items) return;
  float8 sum[PRELIGHT_HARMONIC_COUNT];
  for (int i = 0; i < PRELIGHT_HARMONIC_COUNT; ++i) sum[i] = (float8)(0.0f);
  directions += item * groups * 32;
  for (uint g = 0; g < groups; ++g, directions += 32)
    accumulateHarmonics(table, vload8(0, directions), vload8(1, directions), vload8(2, directions),
                        vload8(3, directions), sum);
  for (int i = 0; i < PRELIGHT_HARMONIC_COUNT; ++i)
    sums[item * PRELIGHT_HARMONIC_COUNT + i] = sumOf(sum[i]) * norms[i];
}
