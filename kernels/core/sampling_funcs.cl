// Low-discrepancy points and the cosine-weighted hemisphere.
// Burley 2020, "Practical Hash-based Owen Scrambling"; the hash is the improved Laine-Karras one (Vegdahl 2021).
#ifndef PRELIGHT_CORE_SAMPLING_FUNCS_CL
#define PRELIGHT_CORE_SAMPLING_FUNCS_CL

uint reverseBits(uint x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

// A bijection of 32-bit integers that mixes well (Wellons' "lowbias32").
uint hashInteger(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

// Owen scrambling of bit-reversed x: every bit is flipped by a hash of the bits below it.
uint scrambleReversed(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

// Returns the second dimension of the Sobol sequence, bit-reversed. Its generator matrix is Pascal's triangle modulo 2,
// so that a product with it takes five shifted exclusive-ors.
uint sobolSecond(uint index) {
  uint x = index;
  x ^= (x & 0xaaaaaaaau) >> 1;
  x ^= (x & 0xccccccccu) >> 2;
  x ^= (x & 0xf0f0f0f0u) >> 4;
  x ^= (x & 0xff00ff00u) >> 8;
  x ^= (x & 0xffff0000u) >> 16;
  return x;  // bit-reversed: the least significant bit weighs 1/2
}

// Returns point `index` of the Owen-scrambled (0,2)-sequence of `seed`, both coordinates as fractions of 2^32.
uint2 sampleSobolBits(uint index, uint seed) {
  const uint a = reverseBits(scrambleReversed(index, hashInteger(seed)));
  const uint b = reverseBits(scrambleReversed(sobolSecond(index), hashInteger(seed ^ 0x9e3779b9u)));
  return (uint2)(a, b);
}

// Converts a fraction of 2^32 to a float in [0,1): 24 bits, so that it stays below 1.
float unitFloat(uint bits) { return (float)(bits >> 8) * 5.9604644775390625e-8f; }

// Returns point `index` of the sequence of sampleSobolBits in [0,1)^2.
float2 sampleSobol(uint index, uint seed) {
  const uint2 bits = sampleSobolBits(index, seed);
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

// Returns points of sampleSobolBits in an order that the seed shuffles: sequences of different seeds can be the
// coordinate pairs of one point of many dimensions ("padding"; Burley 2020, section 5).
uint2 samplePaddedBits(uint index, uint seed) {
  const uint shuffled = reverseBits(scrambleReversed(reverseBits(index), hashInteger(seed ^ 0x85ebca6bu)));
  return sampleSobolBits(shuffled, seed);
}

// Builds an orthonormal frame around unit n (Duff et al. 2017).
void makeFrame(float3 n, float3* tangent, float3* bitangent) {
  const float s = n.z >= 0.0f ? 1.0f : -1.0f;
  const float a = -1.0f / (s + n.z);
  const float b = n.x * n.y * a;
  *tangent = (float3)(1.0f + s * n.x * n.x * a, s * b, -s * n.x);
  *bitangent = (float3)(b, s + n.y * n.y * a, -n.y);
}

// Returns a direction around unit n with density cos/pi.
float3 sampleCosineHemisphere(float2 u, float3 n) {
  float3 tangent, bitangent;
  makeFrame(n, &tangent, &bitangent);
  const float radius = sqrt(u.x);
  const float turn = 2.0f * u.y;  // in units of pi, to avoid the reduction of large arguments
  return radius * cospi(turn) * tangent + radius * sinpi(turn) * bitangent + sqrt(1.0f - u.x) * n;
}

// Returns the weights of a triangle's vertices 1 and 2, uniform over its area, for a point of the unit square.
float2 sampleTriangle(float2 place) {
  const float root = sqrt(place.x);
  return (float2)(root * (1.0f - place.y), root * place.y);
}

#endif
