#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Triangles that hang together by edges, of a surface without any open edge.
struct ClosedPart {
  glm::dvec3 lower{1e300}, upper{-1e300};
  double area = 0.0;
  double volume = 0.0;  ///< negative where faces look inwards
};

/// The parts of a primitive whose every edge is shared by two triangles that run along it in opposite
/// directions, vertices at one place being one. None where an edge is not so shared, or by more.
std::optional<std::vector<ClosedPart>> closedParts(const CompiledScene& scene, const PrimitiveRange& range);

}  // namespace prelight
