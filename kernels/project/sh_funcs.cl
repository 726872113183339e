// Spherical harmonics of eight directions at once: orthonormal, no Condon-Shortley phase, index l(l+1)+m.
// A recurrence in l over Cartesian sectoral terms needs no trigonometry and no division by sin(theta) (Sloan 2013, JCGT
// 2(2)). `table` is computed by the host in double precision and rounded once. It holds:
//   [2 m]                          K_m, so that Y_mm = K_m sin^m(theta) cos(m phi)
//   [2 (n + l n + m)] and [.. + 1] a_lm and c_lm of P_l = a_lm z P_(l-1) - c_lm P_(l-2), l > m; n the order
// With the table of benchmarks/lab/harmonic_tables.h the same functions yield CH, whose recurrence has this form, too.
#ifndef PRELIGHT_PROJECT_SH_FUNCS_CL
#define PRELIGHT_PROJECT_SH_FUNCS_CL

#include "shared/ray_types.h"

// Adds weight x Y_i(x, y, z) to sum[i] for all PRELIGHT_SH_ORDER^2 functions. table: see host/basis/sh_evaluate.h.
void accumulateSh(__constant const float* table, float8 x, float8 y, float8 z, float8 weight, float8* sum) {
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
    float8 value = (float8)(table[2 * m]);
#pragma unroll
    for (int l = m; l < PRELIGHT_SH_ORDER; ++l) {
      if (l > m) {
        const int at = 2 * (PRELIGHT_SH_ORDER + l * PRELIGHT_SH_ORDER + m);
        const float8 next = table[at] * z * value - table[at + 1] * before;
        before = value;
        value = next;
      }
      sum[l * (l + 1) + m] += value * cosine;
      if (m > 0) sum[l * (l + 1) - m] += value * sine;
    }
  }
}

// Adds weights[j] x Y_i of the directions of eight rays j to sum[i].
void accumulateRays(__constant const float* table, __global const Ray* rays, const float* weights, float8* sum) {
  float x[8], y[8], z[8];
  for (int i = 0; i < 8; ++i) {
    x[i] = rays[i].direction[0];
    y[i] = rays[i].direction[1];
    z[i] = rays[i].direction[2];
  }
  accumulateSh(table, vload8(0, x), vload8(0, y), vload8(0, z), vload8(0, weights), sum);
}

// Writes Y_i(w) to values[i] for all PRELIGHT_SH_ORDER^2 functions.
void evaluateSh(__constant const float* table, float3 w, float* values) {
  float cosine = 1.0f, sine = 0.0f;
#pragma unroll
  for (int m = 0; m < PRELIGHT_SH_ORDER; ++m) {
    if (m > 0) {
      const float c = cosine * w.x - sine * w.y;
      sine = sine * w.x + cosine * w.y;
      cosine = c;
    }
    float before = 0.0f;
    float value = table[2 * m];
#pragma unroll
    for (int l = m; l < PRELIGHT_SH_ORDER; ++l) {
      if (l > m) {
        const int at = 2 * (PRELIGHT_SH_ORDER + l * PRELIGHT_SH_ORDER + m);
        const float next = table[at] * w.z * value - table[at + 1] * before;
        before = value;
        value = next;
      }
      values[l * (l + 1) + m] = value * cosine;
      if (m > 0) values[l * (l + 1) - m] = value * sine;
    }
  }
}

#endif
