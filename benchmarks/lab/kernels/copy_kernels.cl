// One work-item per float16: a plain copy, against which relighting is measured.
__kernel void copyLanes(__global const float16* in, uint count, __global float16* out) {
  const size_t i = get_global_id(0);
  if (i < count) out[i] = in[i];
}
