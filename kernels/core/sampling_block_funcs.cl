// Blocks of low-discrepancy points and of cosine-weighted directions, eight at a time, in an order in which neighbours
// have similar directions.
#ifndef PRELIGHT_CORE_SAMPLING_BLOCK_FUNCS_CL
#define PRELIGHT_CORE_SAMPLING_BLOCK_FUNCS_CL

#include "core/sampling_funcs.cl"

uint8 reverseBits8(uint8 x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

uint8 scrambleReversed8(uint8 x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

// Returns the lowest four bits of the x with scrambleReversed(x, seed) = y. A bit of x follows from those below it,
// because the factors are even; a factor that is a multiple of 4 gives two bits per round.
uint8 unscrambleLowBits8(uint8 y, uint seed) {
  const uint8 x = y ^ (y * 0x53a22864u);
  uint8 z = x ^ (x * 0x05526c56u);
  z = x ^ (z * 0x05526c56u);
  z = x ^ (z * 0x05526c56u);
  const uint factor = (seed >> 16) | 1u;
  const uint8 w = z * ((3u * factor) ^ 2u) - seed;  // the factor's inverse modulo 2^5
  z = w ^ (w * 0x3d20adeau);
  z = w ^ (z * 0x3d20adeau);
  return w ^ (z * 0x3d20adeau);
}

uint8 sobolSecond8(uint8 x) {
  x ^= (x & 0xaaaaaaaau) >> 1;
  x ^= (x & 0xccccccccu) >> 2;
  x ^= (x & 0xf0f0f0f0u) >> 4;
  x ^= (x & 0xff00ff00u) >> 8;
  return x ^ ((x & 0xffff0000u) >> 16);
}

// Returns every second bit of a byte, packed.
uint8 evenBits8(uint8 x) {
  x &= 0x55u;
  x = (x | x >> 1) & 0x33u;
  return (x | x >> 2) & 0x0fu;
}

// Returns the index of the point that lies in cell `cell` of the square, among the 2^bits points from `first` on.
// `first` is a multiple of 2^bits, bits = 3..8. Exactly one point does, because the points are a (0,2)-net. Cells lie
// along a Morton curve that halves the first coordinate first, so that an aligned run of 2^n cells is a square or a
// rectangle of two squares.
//
// Read an index as a polynomial f over GF(2), bit i the coefficient of t^i. The point's coordinates are f(t) and
// f(t + 1), scrambled, the lowest bit weighing 1/2. So the column gives the lowest p bits of f. With
// f = known + t^p g, the row gives f(t + 1) = known(t + 1) + (t + 1)^p g(t + 1) modulo t^q: divide by (t + 1)^p, which
// is to multiply by (t + 1)^(-p mod 4) while q <= 4, and put t + 1 for t once more to have g.
uint8 sobolIndexInCell8(uint8 cell, uint bits, uint first, uint seed) {
  const uint p = (bits + 1u) / 2u, q = bits / 2u;
  const uint8 path = reverseBits8(cell) >> (32u - bits);
  const uint8 low = unscrambleLowBits8(evenBits8(path), hashInteger(seed)) & ((1u << p) - 1u);
  const uint8 known = first + low;
  uint8 g = sobolSecond8(known) ^ unscrambleLowBits8(evenBits8(path >> 1), hashInteger(seed ^ 0x9e3779b9u));
  const uint power = (4u - p) & 3u;
  g ^= (g << 1) & (0u - (power & 1u));
  g ^= (g << 2) & (0u - (power >> 1));
  g &= (1u << q) - 1u;
  g ^= (g & 0xau) >> 1;
  g ^= (g & 0xcu) >> 2;
  return known + (g << p);
}

// Writes points `index` of the sequence of `seed`, as sampleSobol does for one index.
void sampleSobol8(uint8 index, uint seed, float8* x, float8* y) {
  const uint8 a = reverseBits8(scrambleReversed8(index, hashInteger(seed)));
  const uint8 b = reverseBits8(scrambleReversed8(sobolSecond8(index), hashInteger(seed ^ 0x9e3779b9u)));
  *x = convert_float8(a >> 8) * 5.9604644775390625e-8f;
  *y = convert_float8(b >> 8) * 5.9604644775390625e-8f;
}

// Maps points of the square to points of the unit disc with areas kept in proportion (Shirley and Chiu 1997): squares
// become compact patches, and angles stay below pi/4, where short series suffice. Writes x, y and the squared radius.
void concentricDisc8(float8 u, float8 v, float8* x, float8* y, float8* squaredRadius) {
  const float8 a = 2.0f * u - 1.0f, b = 2.0f * v - 1.0f;
  const int8 wide = isgreater(fabs(a), fabs(b));
  const float8 radius = select(b, a, wide);
  const float8 ratio = select(a, b, wide) / select(radius, (float8)(1.0f), isequal(radius, (float8)(0.0f)));
  const float8 angle = 0.785398163397448309616f * ratio;
  const float8 s = angle * angle;
  // Taylor series; the truncation error is below 3e-8.
  const float8 sine =
      angle * (1.0f + s * (-1.0f / 6.0f + s * (1.0f / 120.0f + s * (-1.0f / 5040.0f + s * (1.0f / 362880.0f)))));
  const float8 cosine = 1.0f + s * (-0.5f + s * (1.0f / 24.0f + s * (-1.0f / 720.0f + s * (1.0f / 40320.0f))));
  *x = radius * select(sine, cosine, wide);
  *y = radius * select(cosine, sine, wide);
  *squaredRadius = radius * radius;
}

#endif
