#pragma once

#include <glm/glm.hpp>
#include <optional>
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

}  // namespace prelight
