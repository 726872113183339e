#include "lab/kernels/sh_evaluate_funcs.cl"

// One work-item per direction. directions [count][3], of length 1 up to rounding; values [order^2][count];
// table: makeMonicShTable of benchmarks/lab/harmonic_tables.h.
__kernel void evaluateSh(uint count, int order, __global const float4* table, __global const float* directions,
                         __global float* values) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const float3 w = vload3(i, directions);
  evaluateShAt(table, order, w.x, w.y, w.z, (int)count, values + i);
}
