#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// The connected parts of a primitive's triangles.
struct SurfaceParts {
  std::vector<std::uint32_t> partOf;     ///< [triangle of the primitive]
  std::vector<std::uint32_t> triangles;  ///< triangles of the primitive, grouped by part
  std::vector<std::uint32_t> first;      ///< [part] index of its first triangle in `triangles`, then the end

  std::uint32_t count() const { return static_cast<std::uint32_t>(first.size()) - 1; }

  /// Returns the triangles of a part in ascending order.
  std::span<const std::uint32_t> trianglesOf(std::uint32_t part) const {
    return std::span(triangles).subspan(first[part], first[part + 1] - first[part]);
  }
};

/// Returns the parts of a primitive. Triangles are connected if they share a vertex, or an edge that no third
/// triangle has and along which they run in opposite directions; for edges, vertices at exactly the same
/// position count as one.
SurfaceParts surfaceParts(const CompiledScene& scene, const PrimitiveRange& range);

}  // namespace prelight
