// Glossy receivers: matrices turn the light into incident radiance, and a lobe about the reflected view weights it.
// Options: those of lane_funcs.cl, and
//          PRELIGHT_ORDER     bands of both sides of the matrices
//          PRELIGHT_CHANNELS  channels of the matrices, 1 or 3
#include "relight/lane_funcs.cl"

#ifndef PRELIGHT_ORDER
#define PRELIGHT_ORDER 4
#endif
#ifndef PRELIGHT_CHANNELS
#define PRELIGHT_CHANNELS 3
#endif

#define COUNT (PRELIGHT_ORDER * PRELIGHT_ORDER)

void storeRow(Lanes values, __global float* row) {
#ifdef PRELIGHT_WIDE_LANES
  vstore16(values, 0, row);
#else
  *row = values;
#endif
}

// One work-item per PRELIGHT_VERTICES_AN_ITEM vertices. matrices [tile][channel][i][j][lane], light [channel][j] ->
// arriving [tile][3][i][lane]: coefficients of incident radiance x visibility x cosine / pi. Run once per light.
__kernel void lightMatrices(__global const Stored* matrices, __constant const float* light, uint vertexCount,
                            __global float* arriving) {
  const size_t item = get_global_id(0);
  if (item * PRELIGHT_VERTICES_AN_ITEM >= vertexCount) return;
  matrices += firstOfItem(item, PRELIGHT_CHANNELS * COUNT * COUNT);
  arriving += firstOfItem(item, 3 * COUNT);
#if PRELIGHT_CHANNELS == 3
  for (int row = 0; row < 3 * COUNT; ++row) {
    Lanes sum = 0.0f;
#pragma unroll 4
    for (int j = 0; j < COUNT; ++j)
      sum += loadStored(matrices + (row * COUNT + j) * PRELIGHT_TILE) * light[row / COUNT * COUNT + j];
    storeRow(sum, arriving + row * PRELIGHT_TILE);
  }
#else
  for (int row = 0; row < COUNT; ++row) {
    Lanes red = 0.0f, green = 0.0f, blue = 0.0f;
    for (int j = 0; j < COUNT; ++j) {
      const Lanes value = loadStored(matrices + (row * COUNT + j) * PRELIGHT_TILE);
      red += value * light[j];
      green += value * light[COUNT + j];
      blue += value * light[2 * COUNT + j];
    }
    storeRow(red, arriving + row * PRELIGHT_TILE);
    storeRow(green, arriving + (COUNT + row) * PRELIGHT_TILE);
    storeRow(blue, arriving + (2 * COUNT + row) * PRELIGHT_TILE);
  }
#endif
}

// Returns one coordinate of the direction of each of the item's vertices.
Lanes __attribute__((always_inline))
loadCoordinate(__global const float* directions, int axis, size_t item, uint vertexCount) {
#ifdef PRELIGHT_WIDE_LANES
  float values[PRELIGHT_TILE];
  for (size_t lane = 0; lane < PRELIGHT_TILE; ++lane)
    values[lane] = directions[3 * min((size_t)vertexCount - 1, item * PRELIGHT_TILE + lane) + axis];
  return vload16(0, values);
#else
  return directions[3 * item + axis];
#endif
}

// arriving as above, directions [vertex][3] unit (the view reflected at the normal), lobe [band]: the zonal lobe about
// the direction -> radiance [vertex][3] = sum_l lobe_l sum_m arriving_lm Y_lm(direction). Run once per view. table: the
// recurrence of host/basis, as in kernels/project/sh_funcs.cl.
__kernel void shadeGlossy(__global const float* arriving, __global const float* directions,
                          __constant const float* lobe, __constant const float* table, uint vertexCount,
                          __global float* radiance) {
  const size_t item = get_global_id(0);
  if (item * PRELIGHT_VERTICES_AN_ITEM >= vertexCount) return;
  arriving += firstOfItem(item, 3 * COUNT);
  const Lanes x = loadCoordinate(directions, 0, item, vertexCount);
  const Lanes y = loadCoordinate(directions, 1, item, vertexCount);
  const Lanes z = loadCoordinate(directions, 2, item, vertexCount);
  Lanes color[3] = {0.0f, 0.0f, 0.0f};
  Lanes cosine = 1.0f, sine = 0.0f;  // sin^m(theta) cos(m phi) and sin^m(theta) sin(m phi)
  for (int m = 0; m < PRELIGHT_ORDER; ++m) {
    if (m > 0) {
      const Lanes next = cosine * x - sine * y;
      sine = sine * x + cosine * y;
      cosine = next;
    }
    Lanes before = 0.0f, value = table[2 * m];
    for (int l = m; l < PRELIGHT_ORDER; ++l) {
      if (l > m) {
        const int at = 2 * (PRELIGHT_ORDER + l * PRELIGHT_ORDER + m);
        const Lanes next = table[at] * z * value - table[at + 1] * before;
        before = value;
        value = next;
      }
      const int i = l * (l + 1);
      for (int c = 0; c < 3; ++c) {
        __global const float* row = arriving + c * COUNT * PRELIGHT_TILE;
        Lanes wave = LOAD_ROW(row + (i + m) * PRELIGHT_TILE) * cosine;
        if (m > 0) wave += LOAD_ROW(row + (i - m) * PRELIGHT_TILE) * sine;
        color[c] += lobe[l] * value * wave;
      }
    }
  }
  storeColors(color[0], color[1], color[2], item, vertexCount, radiance);
}
