// Dense dot products of transfer and light.
// Options: those of lane_funcs.cl, and PRELIGHT_COUNT  coefficients a channel
//                                      PRELIGHT_CHANNELS  of the transfer, 1 or 3
#include "relight/lane_funcs.cl"

#ifndef PRELIGHT_COUNT
#define PRELIGHT_COUNT 36
#endif
#ifndef PRELIGHT_CHANNELS
#define PRELIGHT_CHANNELS 3
#endif

#define ROWS (PRELIGHT_CHANNELS * PRELIGHT_COUNT)

// Radiance before albedo. light: [channel][i], then a constant for each colour.
void dotProducts(__global const Stored* transfer, __constant const float* light, Lanes* color) {
  for (int c = 0; c < 3; ++c) color[c] = light[3 * PRELIGHT_COUNT + c];
#if PRELIGHT_CHANNELS == 3
  for (int c = 0; c < 3; ++c)
#pragma unroll 4
    for (int i = 0; i < PRELIGHT_COUNT; ++i)
      color[c] += loadStored(transfer + (c * PRELIGHT_COUNT + i) * PRELIGHT_TILE) * light[c * PRELIGHT_COUNT + i];
#else
  for (int i = 0; i < PRELIGHT_COUNT; ++i) {
    const Lanes value = loadStored(transfer + i * PRELIGHT_TILE);
    for (int c = 0; c < 3; ++c) color[c] += value * light[c * PRELIGHT_COUNT + i];
  }
#endif
}

// A work-item takes PRELIGHT_VERTICES_AN_ITEM vertices. transfer [tile][channel][i][lane], light as above ->
// radiance [vertex][3].
__kernel void relightDense(__global const Stored* transfer, __constant const float* light, uint vertexCount,
                           __global float* radiance) {
  const size_t item = get_global_id(0);
  if (item * PRELIGHT_VERTICES_AN_ITEM >= vertexCount) return;
  Lanes color[3];
  dotProducts(transfer + firstOfItem(item, ROWS), light, color);
  storeColors(color[0], color[1], color[2], item, vertexCount, radiance);
}

// The same between two keys of an animation: (1 - blend) x the first + blend x the second.
__kernel void relightBetweenKeys(__global const Stored* first, __global const Stored* second, float blend,
                                 __constant const float* light, uint vertexCount, __global float* radiance) {
  const size_t item = get_global_id(0);
  if (item * PRELIGHT_VERTICES_AN_ITEM >= vertexCount) return;
  Lanes before[3], after[3];
  dotProducts(first + firstOfItem(item, ROWS), light, before);
  dotProducts(second + firstOfItem(item, ROWS), light, after);
  for (int c = 0; c < 3; ++c) before[c] += blend * (after[c] - before[c]);
  storeColors(before[0], before[1], before[2], item, vertexCount, radiance);
}
