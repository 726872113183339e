// Vectors of lanes: their minimum, their maximum, and comparisons as bit masks.
#ifndef PRELIGHT_BVH_LANE_FUNCS_CL
#define PRELIGHT_BVH_LANE_FUNCS_CL

#include "core/inline.h"

// x86 turns a comparison into a mask with an instruction that OpenCL C has no name for. Where the compiler offers it,
// it is taken; PRELIGHT_PORTABLE_LANES keeps to the language, as other devices do.
#if !defined(PRELIGHT_PORTABLE_LANES) && defined(__has_builtin)
#if defined(__AVX__) && __has_builtin(__builtin_ia32_movmskps256)
#define PRELIGHT_AVX_LANES
#endif
#if defined(__SSE2__) && __has_builtin(__builtin_ia32_pmovmskb128)
#define PRELIGHT_SSE2_LANES
#endif
#if defined(__AVX512F__) && defined(__AVX512VL__) && __has_builtin(__builtin_ia32_cmpps512_mask)
#define PRELIGHT_AVX512_LANES
#endif
#if __has_builtin(__builtin_prefetch)
#define PRELIGHT_PREFETCH
#endif
#endif

// vminps/vmaxps: returns b when either is NaN.
float8 least8(float8 a, float8 b) { return select(b, a, a < b); }
float8 most8(float8 a, float8 b) { return select(b, a, a > b); }
float16 least16(float16 a, float16 b) { return select(b, a, a < b); }
float16 most16(float16 a, float16 b) { return select(b, a, a > b); }

// Bit i set: lane i of the comparison is true.
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

// Bit i set: a[i] <= b[i].
uint lessOrEqualMask16(float16 a, float16 b) {
#ifdef PRELIGHT_AVX512_LANES
  return (uint)__builtin_ia32_cmpps512_mask(a, b, 2, (ushort)0xffff, 4);
#else
  const int16 lanes = a <= b;
  return laneMask8(lanes.lo) | (laneMask8(lanes.hi) << 8);
#endif
}

// Bit i set: bit `bit` of byte i is set.
uint byteMask16(uchar16 bytes, uint bit) {
#ifdef PRELIGHT_SSE2_LANES
  // What a shift carries from a byte into its neighbour lies below the sign that is taken.
  return (uint)__builtin_ia32_pmovmskb128(as_char16(as_ushort8(bytes) << (ushort8)(7u - bit)));
#else
  const ushort16 found = (convert_ushort16(bytes) >> (ushort16)(bit)) & (ushort16)(1);
  const ushort16 bits = found << (ushort16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const ushort8 a = bits.lo | bits.hi;
  const ushort4 b = a.lo | a.hi;
  const ushort2 c = b.lo | b.hi;
  return (uint)(c.x | c.y);
#endif
}

// Four keys, the largest first: a sorting network of five comparisons.
ulong4 descending4(ulong4 k) {
  ulong4 p = k.zwxy;
  k = (ulong4)(max(k, p).xy, min(k, p).zw);
  p = k.yxwz;
  const ulong4 high = max(k, p), low = min(k, p);
  k = (ulong4)(high.x, low.y, high.z, low.w);
  p = k.xzyw;
  return (ulong4)(max(k, p).xy, min(k, p).zw);
}

#ifdef PRELIGHT_AVX512_LANES
// The lanes of the mask moved together, zeros behind them.
uint8 together8(uint8 v, uint mask) {
  return as_uint8(__builtin_ia32_compresssi256_mask(as_int8(v), (int8)(0), (uchar)mask));
}
ulong8 togetherLong8(ulong8 v, uint mask) {
  return as_ulong8(__builtin_ia32_compressdi512_mask(as_long8(v), (long8)(0), (uchar)mask));
}
#endif

// Index of the lowest bit of a mask that is not 0: written so that compilers see a count of trailing zeros.
uint lowestLane(uint mask) { return popcount(~mask & (mask - 1u)); }

// Asks for the cache lines of `bytes` from `address` on.
void prefetchBytes(__global const char* address, uint bytes) {
#ifdef PRELIGHT_PREFETCH
  for (uint at = 0; at < bytes; at += 64) __builtin_prefetch(address + at);
#endif
}

#endif
