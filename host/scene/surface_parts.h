#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// The pieces that a primitive's triangles make.
struct SurfaceParts {
  std::vector<std::uint32_t> partOf;     ///< [triangle of the primitive]
  std::vector<std::uint32_t> triangles;  ///< of the primitive, those of one part after the other
  std::vector<std::uint32_t> first;      ///< [part], its place among them, and their end

  std::uint32_t count() const { return static_cast<std::uint32_t>(first.size()) - 1; }

  /// In ascending order.
  std::span<const std::uint32_t> trianglesOf(std::uint32_t part) const {
    return std::span(triangles).subspan(first[part], first[part + 1] - first[part]);
  }
};

/// Triangles are of one part where they share a vertex, or an edge that no third triangle has and along which
/// they run in opposite directions; vertices at the very same place count as one for that.
SurfaceParts surfaceParts(const CompiledScene& scene, const PrimitiveRange& range);

}  // namespace prelight
