#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace prelight {

/// A direction folded onto an octahedron and that onto a square, as two integers of equal bits (Meyer et al.
/// 2010; Cigolle et al. 2014): the square's cell nearest to the direction.
struct Octahedral {
  std::uint32_t u = 0;
  std::uint32_t v = 0;
};

/// Returns a direction's place in the unit square: z is up, and the lower half folds outwards. The direction
/// need not be unit; one without length becomes +Z.
inline glm::dvec2 octahedralPlace(const glm::dvec3& direction) {
  const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  glm::dvec2 place = sum > 0.0 ? glm::dvec2(direction) / sum : glm::dvec2(0.0);
  if (direction.z < 0.0)
    place = {(1.0 - std::abs(place.y)) * (place.x >= 0.0 ? 1.0 : -1.0),
             (1.0 - std::abs(place.x)) * (place.y >= 0.0 ? 1.0 : -1.0)};
  return (place + 1.0) / 2.0;
}

/// Returns the unit direction of a place.
inline glm::dvec3 octahedralDirection(const glm::dvec2& place) {
  const double x = place.x * 2.0 - 1.0, y = place.y * 2.0 - 1.0;
  const double z = 1.0 - std::abs(x) - std::abs(y), under = std::max(-z, 0.0);
  return glm::normalize(glm::dvec3(x + (x >= 0.0 ? -under : under), y + (y >= 0.0 ? -under : under), z));
}

/// Returns the cell of octahedralPlace(); bits: 2..16 each. The direction is off by at most sqrt(18) /
/// (2^bits - 1), and by 1.65 / (2^bits - 1) rms.
inline Octahedral toOctahedral(const glm::dvec3& direction, int bits) {
  const glm::dvec2 place = octahedralPlace(direction) * double((1u << bits) - 1u);
  return {static_cast<std::uint32_t>(std::lround(place.x)), static_cast<std::uint32_t>(std::lround(place.y))};
}

/// Returns the unit direction of a cell.
inline glm::dvec3 fromOctahedral(const Octahedral& folded, int bits) {
  return octahedralDirection(glm::dvec2(folded.u, folded.v) / double((1u << bits) - 1u));
}

/// Packs a direction in 32 bits, u in the lower half: off by at most 6.5e-5. kernels/core/octahedral_funcs.cl
/// uses the same format.
inline std::uint32_t packDirection(const glm::dvec3& direction) {
  const Octahedral folded = toOctahedral(direction, 16);
  return folded.u | folded.v << 16;
}

/// Returns the unit direction that packDirection() has packed.
inline glm::dvec3 unpackDirection(std::uint32_t packed) {
  return fromOctahedral({packed & 0xffffu, packed >> 16}, 16);
}

/// Returns unit directions distributed evenly over the sphere, from +Z to -Z: a spiral whose steps turn by
/// the golden angle.
inline std::vector<glm::dvec3> spiralDirections(int count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, ring = std::sqrt(1.0 - z * z);
    directions.emplace_back(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
  }
  return directions;
}

/// Returns direction number `index` of a spiral of golden angles around a unit axis, with this cosine to it.
/// With evenly spaced cosines the directions are uniform over a cap of the sphere or all of it.
inline glm::dvec3 directionAbout(const glm::dvec3& axis, double cosine, int index) {
  const glm::dvec3 helper = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, axis)), y = glm::cross(axis, x);
  const double across = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double turn = 2.399963229728653 * index + 0.1;
  return cosine * axis + across * (std::cos(turn) * x + std::sin(turn) * y);
}

}  // namespace prelight
