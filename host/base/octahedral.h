#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

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

}  // namespace prelight
