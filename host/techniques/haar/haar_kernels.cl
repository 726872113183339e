// Sparse dot products in the Haar basis, by two methods.
// Options: PRELIGHT_CHANNELS      channels of the transfer, 1 or 3
//          PRELIGHT_BLOCK         vertices per work-group of relightHaarColumns
//          PRELIGHT_COLUMN_COUNT  6 S^2

#ifndef PRELIGHT_CHANNELS
#define PRELIGHT_CHANNELS 3
#endif
#ifndef PRELIGHT_BLOCK
#define PRELIGHT_BLOCK 1024
#endif
#ifndef PRELIGHT_COLUMN_COUNT
#define PRELIGHT_COLUMN_COUNT 24576
#endif

// By rows, one work-item per vertex: every stored coefficient is multiplied by its entry of the light, which is 0 for
// most. offsets [vertex * channels + channel], indices, values: as in HaarTransfer. light [index][4] -> radiance
// [vertex][3].
__kernel void relightHaarRows(__global const uint* offsets, __global const uint* indices, __global const float* values,
                              __global const float* light, uint vertexCount, __global float* radiance) {
  const size_t vertex = get_global_id(0);
  if (vertex >= vertexCount) return;
  float color[3] = {0.0f, 0.0f, 0.0f};
#if PRELIGHT_CHANNELS == 3
  for (int c = 0; c < 3; ++c) {
    const uint end = offsets[3 * vertex + c + 1];
    float sum = 0.0f;
    for (uint at = offsets[3 * vertex + c]; at < end; ++at) sum += values[at] * light[4 * indices[at] + c];
    color[c] = sum;
  }
#else
  float4 sum = 0.0f;
  const uint end = offsets[vertex + 1];
  for (uint at = offsets[vertex]; at < end; ++at) sum += values[at] * vload4(indices[at], light);
  color[0] = sum.x;
  color[1] = sum.y;
  color[2] = sum.z;
#endif
  for (int c = 0; c < 3; ++c) radiance[3 * vertex + c] = color[c];
}

// By columns, one work-group per block of vertices: only the columns that the light has are read (Ng 2003). Entries of
// a column belong to different vertices, so items never add to the same sum, and columns come in the light's order, so
// sums do not depend on the group's size. offsets [block][channel][column] and the end; vertices [entry], in the block;
// values [entry]; lit [k], the columns of the light, litColors [k][4] -> radiance [vertex][3].
__kernel void relightHaarColumns(__global const uint* offsets, __global const ushort* vertices,
                                 __global const float* values, __global const uint* lit,
                                 __global const float* litColors, uint litCount, uint vertexCount,
                                 __global float* radiance) {
  __local float sums[3 * PRELIGHT_BLOCK];
  const size_t item = get_local_id(0), items = get_local_size(0), block = get_group_id(0);
  for (size_t i = item; i < 3 * PRELIGHT_BLOCK; i += items) sums[i] = 0.0f;
  offsets += block * PRELIGHT_CHANNELS * PRELIGHT_COLUMN_COUNT;
  for (uint k = 0; k < litCount; ++k) {
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint column = lit[k];
    const float4 color = vload4(k, litColors);
#if PRELIGHT_CHANNELS == 3
    const float own[3] = {color.x, color.y, color.z};
    for (int c = 0; c < 3; ++c) {
      const uint end = offsets[c * PRELIGHT_COLUMN_COUNT + column + 1];
      for (uint at = offsets[c * PRELIGHT_COLUMN_COUNT + column] + item; at < end; at += items)
        sums[3 * vertices[at] + c] += values[at] * own[c];
    }
#else
    const uint end = offsets[column + 1];
    for (uint at = offsets[column] + item; at < end; at += items) {
      const float value = values[at];
      __local float* sum = sums + 3 * vertices[at];
      sum[0] += value * color.x;
      sum[1] += value * color.y;
      sum[2] += value * color.z;
    }
#endif
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const size_t first = block * PRELIGHT_BLOCK;
  const size_t count = 3 * min((size_t)PRELIGHT_BLOCK, vertexCount - first);
  for (size_t i = item; i < count; i += items) radiance[3 * first + i] = sums[i];
}
