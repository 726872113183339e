#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// The unknowns of a vertex fit. Vertices of the same position and normal (copies along texture seams) share
/// a slot, so that no seam can open between them. Slots that a triangle joins are neighbours.
struct FitMesh {
  std::vector<std::uint32_t> slotOfVertex;              ///< [vertex]
  std::vector<std::uint32_t> vertexOfSlot;              ///< [slot], one of its vertices
  std::vector<glm::vec3> positions;                     ///< [slot]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< [triangle], slots of its corners
  std::vector<std::uint32_t> rowStart;                  ///< [slot + 1], into columns
  std::vector<std::uint32_t> columns;      ///< neighbours of each slot, ascending, without itself
  std::vector<std::uint32_t> cornerStart;  ///< [slot + 1], into corners
  std::vector<std::uint32_t> corners;      ///< 3 x triangle + corner of each slot, ascending
  std::vector<std::uint32_t> components;   ///< [slot], the lowest slot that triangles join it to

  std::uint32_t slotCount() const { return static_cast<std::uint32_t>(vertexOfSlot.size()); }
};

/// Vertices of different `classes` do not share a slot: [vertex], or empty.
FitMesh makeFitMesh(const CompiledScene& scene, std::span<const std::uint32_t> classes = {});

}  // namespace prelight
