#include "receivers/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight::sampling {

namespace {

std::uint32_t reverseBits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

/// Returns the second Sobol dimension, bit-reversed, by its definition: bit i of the index adds generator
/// 2^31 Pascal(i).
std::uint32_t sobolSecondReversed(std::uint32_t index) {
  std::uint32_t value = 0;
  for (std::uint32_t generator = 1u << 31; index != 0; index >>= 1, generator ^= generator >> 1)
    if (index & 1u) value ^= generator;
  return reverseBits(value);
}

}  // namespace

std::uint32_t hashInteger(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ (x >> 16);
}

glm::dvec2 sobol(std::uint32_t index, std::uint32_t seed) {
  const std::uint32_t a = reverseBits(scrambleReversed(index, hashInteger(seed)));
  const std::uint32_t b =
      reverseBits(scrambleReversed(sobolSecondReversed(index), hashInteger(seed ^ 0x9e3779b9u)));
  return glm::dvec2(a >> 8, b >> 8) * 0x1p-24;
}

std::uint32_t shuffledIndex(std::uint32_t index, std::uint32_t seed) {
  return reverseBits(scrambleReversed(reverseBits(index), hashInteger(seed)));
}

glm::dvec2 concentricDisc(const glm::dvec2& u) {
  const glm::dvec2 c = 2.0 * u - 1.0;
  const bool wide = std::abs(c.x) > std::abs(c.y);
  const double radius = wide ? c.x : c.y;
  if (radius == 0.0) return {0.0, 0.0};
  const double angle = 0.25 * std::numbers::pi * (wide ? c.y : c.x) / radius;
  return radius *
         (wide ? glm::dvec2(std::cos(angle), std::sin(angle)) : glm::dvec2(std::sin(angle), std::cos(angle)));
}

glm::dvec3 cosineHemisphere(const glm::dvec2& u, const glm::dvec3& n) {
  const double s = n.z >= 0.0 ? 1.0 : -1.0;
  const double a = -1.0 / (s + n.z);
  const double b = n.x * n.y * a;
  const glm::dvec3 tangent(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
  const glm::dvec3 bitangent(b, s + n.y * n.y * a, -n.y);
  const glm::dvec2 disc = concentricDisc(u);
  return disc.x * tangent + disc.y * bitangent + std::sqrt(std::max(0.0, 1.0 - glm::dot(disc, disc))) * n;
}

glm::dvec2 uniformTriangle(const glm::dvec2& u) {
  const double root = std::sqrt(u.x);
  return {root * (1.0 - u.y), root * u.y};
}

}  // namespace prelight::sampling
