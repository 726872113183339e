#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "scene/closed_parts.h"

namespace prelight {

/// More bodies than anybody models by mistake: they are left as they are, for the time that they would take.
constexpr std::size_t mostClosedBodies = 1000;

/// Where the fronts of closed bodies look.
enum class BodySide : std::uint8_t { Unclear, Outside, Inside };

/// Of a primitive that is closed bodies beside each other; Unclear where it is not, where they differ, and
/// where one is too flat to tell.
BodySide sideOfBodies(const CompiledScene& scene, const PrimitiveRange& range);

/// Bounds, area and volume of a primitive as if it were closed.
ClosedPart asClosed(const CompiledScene& scene, const PrimitiveRange& range);

/// Centres of the bounds of bodies, to ask what lies within one.
class BodyCentres {
 public:
  explicit BodyCentres(std::span<const ClosedPart> bodies);

  /// Whether the centre of any but one lies strictly within bounds.
  bool anyWithin(const ClosedPart& bounds, std::uint32_t butNot) const;

 private:
  std::vector<std::pair<glm::dvec3, std::uint32_t>> centres_;  ///< by the first coordinate
};

/// What emissive double-sided primitives light: Outside or Inside where they are closed bodies whose other
/// side sees nothing but itself, by which side their fronts look to; Unclear: both sides. [primitive].
std::vector<BodySide> glowingBodies(const CompiledScene& scene);

}  // namespace prelight
