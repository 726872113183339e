#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Triangles connected by edges that form a surface without open edges.
struct ClosedPart {
  glm::dvec3 lower{1e300}, upper{-1e300};
  double area = 0.0;
  double volume = 0.0;  ///< negative where faces look inwards
};

/// Returns the closed parts of a primitive if each of its edges is shared by exactly two triangles that run
/// along it in opposite directions, where vertices at one position count as one. Returns nothing otherwise.
std::optional<std::vector<ClosedPart>> closedParts(const CompiledScene& scene, const PrimitiveRange& range);

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

/// Returns [triangle] 1 where it belongs to a solid into which other surfaces reach, judged by bounds: a
/// closed surface of opaque, one-sided faces that look outwards. Surfaces inside it are not visible. Empty
/// where there is none.
std::vector<std::uint8_t> trianglesOfEnteredSolids(const CompiledScene& scene);

}  // namespace prelight
