// Kernel that packs and unpacks directions, for tests.
#include "core/octahedral_funcs.cl"

// One work-item per direction. directions [direction] (w unused) -> packed [direction], unpacked [direction] (w 0).
__kernel void probeDirections(const uint count, __global const float4* directions, __global uint* packed,
                              __global float4* unpacked) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  packed[i] = packDirection(directions[i].xyz);
  unpacked[i] = (float4)(unpackDirection(packed[i]), 0.0f);
}
