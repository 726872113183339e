// Functions of vectors of lanes: minimum, maximum, permutations, and comparisons as bit masks.
#ifndef PRELIGHT_BVH_LANE_FUNCS_CL
#define PRELIGHT_BVH_LANE_FUNCS_CL

#include "core/inline.h"
#include "core/prefetch_funcs.cl"

// x86 turns a comparison into a mask with an instruction for which OpenCL C has no name. The instruction is used where
// the compiler offers it. PRELIGHT_PORTABLE_LANES keeps to the language, as on other devices.
#if !defined(PRELIGHT_PORTABLE_LANES) && defined(__has_builtin)
#if defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
#define PRELIGHT_AVX_LANES
#endif
#if defined(__AVX512DQ__) && defined(__AVX512VL__) && __has_builtin(__builtin_ia32_cmpps512_mask) && \
    __has_builtin(__builtin_ia32_cvtd2mask512) && __has_builtin(__builtin_ia32_compresssi256_mask) &&    \
    __has_builtin(__builtin_ia32_compressdi512_mask) && __has_builtin(__builtin_ia32_permvarsi256)
#define PRELIGHT_AVX512_LANES
#endif
#if defined(__AVX2__) && defined(__BMI2__) && __has_builtin(__builtin_ia32_permvarsi256) && \
    __has_builtin(__builtin_ia32_pdep_di) && __has_builtin(__builtin_ia32_pext_di)
#define PRELIGHT_AVX2_LANES
#endif
#endif

// Minimum and maximum as vminps/vmaxps compute them: b when either is NaN.
float8 least8(float8 a, float8 b) { return select(b, a, a < b); }
float8 most8(float8 a, float8 b) { return select(b, a, a > b); }
float16 least16(float16 a, float16 b) { return select(b, a, a < b); }
float16 most16(float16 a, float16 b) { return select(b, a, a > b); }

float least1(float16 v) {
  const float8 a = least8(v.lo, v.hi);
  const float4 b = select(a.hi, a.lo, a.lo < a.hi);
  const float2 c = select(b.hi, b.lo, b.lo < b.hi);
  return c.x < c.y ? c.x : c.y;
}

// Interleaves the elements of a and b, beginning with a's: the first halves (low) or the second halves (high).
float16 riffledLow16(float16 a, float16 b) {
  return (float16)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3, a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7, b.s7);
}
float16 riffledHigh16(float16 a, float16 b) {
  return (float16)(a.s8, b.s8, a.s9, b.s9, a.sa, b.sa, a.sb, b.sb, a.sc, b.sc, a.sd, b.sd, a.se, b.se, a.sf, b.sf);
}

// Returns a mask whose bit i is set when lane i of the comparison is true.
uint laneMask8(int8 lanes) {
#ifdef PRELIGHT_AVX_LANES
  return (uint)__builtin_ia32_movmskps256(as_float8(lanes));
#else
  const int8 bits = lanes & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 a = bits.lo | bits.hi;
  const int2 b = a.lo | a.hi;
  return (uint)(b.x | b.y);
#endif
}

// Returns a mask whose bit i is set when a[i] <= b[i].
uint lessOrEqualMask16(float16 a, float16 b) {
#ifdef PRELIGHT_AVX512_LANES
  return (uint)__builtin_ia32_cmpps512_mask(a, b, 2, (ushort)0xffff, 4);
#else
  const int16 lanes = a <= b;
  return laneMask8(lanes.lo) | (laneMask8(lanes.hi) << 8);
#endif
}

// Returns a mask whose bit i is set when lane i of the comparison is true.
uint laneMask16(int16 lanes) {
#ifdef PRELIGHT_AVX512_LANES
  return (uint)__builtin_ia32_cvtd2mask512(lanes);
#else
  return laneMask8(lanes.lo) | (laneMask8(lanes.hi) << 8);
#endif
}

// Sorts four keys, the largest first, with a network of five comparisons.
ulong4 descendingLong4(ulong4 k) {
  ulong4 p = k.zwxy, high = max(k, p), low = min(k, p);
  k = (ulong4)(high.xy, low.zw);
  p = k.yxwz, high = max(k, p), low = min(k, p);
  k = (ulong4)(high.x, low.y, high.z, low.w);
  p = k.xzyw, high = max(k, p), low = min(k, p);
  return (ulong4)(high.xy, low.zw);
}
uint4 descending4(uint4 k) {
  uint4 p = k.zwxy, high = max(k, p), low = min(k, p);
  k = (uint4)(high.xy, low.zw);
  p = k.yxwz, high = max(k, p), low = min(k, p);
  k = (uint4)(high.x, low.y, high.z, low.w);
  p = k.xzyw, high = max(k, p), low = min(k, p);
  return (uint4)(high.xy, low.zw);
}

#if defined(PRELIGHT_AVX512_LANES) || defined(PRELIGHT_AVX2_LANES)
// Returns v[index[i]] in lane i.
uint8 permuted8(uint8 v, uint8 index) { return as_uint8(__builtin_ia32_permvarsi256(as_int8(v), as_int8(index))); }
#endif

// Returns the lanes of a mask moved together, with zeros behind them. Without an instruction for it, a loop over the
// mask is faster.
#ifdef PRELIGHT_AVX512_LANES
#define PRELIGHT_TOGETHER
uint8 together8(uint8 v, uint mask) {
  return as_uint8(__builtin_ia32_compresssi256_mask(as_int8(v), (int8)(0), (uchar)mask));
}
#elif defined(PRELIGHT_AVX2_LANES)
#define PRELIGHT_TOGETHER
uint8 together8(uint8 v, uint mask) {
  const ulong lanes = __builtin_ia32_pdep_di((ulong)mask, 0x0101010101010101ul) * 0xfful;
  const uint8 moved = permuted8(v, convert_uint8(as_uchar8(__builtin_ia32_pext_di(0x0706050403020100ul, lanes))));
  return moved & as_uint8((int8)(0, 1, 2, 3, 4, 5, 6, 7) < (int8)((int)popcount(mask)));
}
#endif

// Returns the index of the lowest bit of a mask that is not 0, written so that compilers recognise a count of trailing
// zeros.
uint lowestLane(uint mask) { return popcount(~mask & (mask - 1u)); }

#endif
