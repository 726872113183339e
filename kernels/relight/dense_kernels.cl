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

typedef struct Colors {
  Lanes red, green, blue;
} Colors;

#if PRELIGHT_CHANNELS == 3
#define CHANNEL_ROWS PRELIGHT_COUNT
#else
#define CHANNEL_ROWS 0
#endif

// Returns radiance before albedo. light: [channel][i], then a constant per colour. The sums stay in registers: adding
// through a pointer, which the compiler must write back each time, halves the rate. Walking through the channels side
// by side gives the memory three streams to fetch ahead of, a tenth more than one.
Colors __attribute__((always_inline)) dotProducts(__global const Stored* transfer, __constant const float* light) {
  __constant const float* constants = light + 3 * PRELIGHT_COUNT;
  Colors sum;
  sum.red = constants[0];
  sum.green = constants[1];
  sum.blue = constants[2];
#pragma unroll 4
  for (int i = 0; i < PRELIGHT_COUNT; ++i) {
    __global const Stored* row = transfer + i * PRELIGHT_TILE;
    sum.red += loadStored(row) * light[i];
    sum.green += loadStored(row + CHANNEL_ROWS * PRELIGHT_TILE) * light[PRELIGHT_COUNT + i];
    sum.blue += loadStored(row + 2 * CHANNEL_ROWS * PRELIGHT_TILE) * light[2 * PRELIGHT_COUNT + i];
  }
  return sum;
}

// Each work-item relights PRELIGHT_VERTICES_AN_ITEM vertices. transfer [tile][channel][i][lane], light as above ->
// radiance [vertex][3].
__kernel void relightDense(__global const Stored* transfer, __constant const float* light, uint vertexCount,
                           __global float* radiance) {
  const size_t item = get_global_id(0);
  if (item * PRELIGHT_VERTICES_AN_ITEM >= vertexCount) return;
  const Colors color = dotProducts(transfer + firstOfItem(item, ROWS), light);
  storeColors(color.red, color.green, color.blue, item, vertexCount, radiance);
}

// Relights between two keys of an animation: (1 - blend) x the first + blend x the second.
__kernel void relightBetweenKeys(__global const Stored* first, __global const Stored* second, float blend,
                                 __constant const float* light, uint vertexCount, __global float* radiance) {
  const size_t item = get_global_id(0);
  if (item * PRELIGHT_VERTICES_AN_ITEM >= vertexCount) return;
  const Colors before = dotProducts(first + firstOfItem(item, ROWS), light);
  const Colors after = dotProducts(second + firstOfItem(item, ROWS), light);
  storeColors(before.red + blend * (after.red - before.red), before.green + blend * (after.green - before.green),
              before.blue + blend * (after.blue - before.blue), item, vertexCount, radiance);
}
