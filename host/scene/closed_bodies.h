#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "scene/closed_parts.h"

namespace prelight {

/// Greatest number of bodies that are examined, because of the time that it takes. No modelling mistake has
/// more.
constexpr std::size_t mostClosedBodies = 1000;

/// The side to which the fronts of closed bodies face.
enum class BodySide : std::uint8_t { Unclear, Outside, Inside };

/// Returns the side of a primitive that consists of closed bodies beside each other. Unclear where it does
/// not, where the bodies differ, and where one is too flat to tell.
BodySide sideOfBodies(const CompiledScene& scene, const PrimitiveRange& range);

/// Returns bounds, area and volume of a primitive as if it were closed.
ClosedPart asClosed(const CompiledScene& scene, const PrimitiveRange& range);

/// The centres of bodies' bounds, for queries of which lie within a body.
class BodyCentres {
 public:
  explicit BodyCentres(std::span<const ClosedPart> bodies);

  /// Returns true when the centre of any body except `butNot` lies strictly within bounds.
  bool anyWithin(const ClosedPart& bounds, std::uint32_t butNot) const;

 private:
  std::vector<std::pair<glm::dvec3, std::uint32_t>> centres_;  ///< sorted by the first coordinate
};

/// Returns [primitive] the sides that emissive double-sided primitives light. Outside or Inside for closed
/// bodies whose other side sees nothing but the body itself, according to the side to which their fronts
/// face; Unclear for both sides.
std::vector<BodySide> glowingBodies(const CompiledScene& scene);

}  // namespace prelight
