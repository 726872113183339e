#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// The unknowns of a vertex fit, called slots. Vertices with equal position and normal (copies along texture
/// seams) share one slot, so that no seam can open between them. Slots connected by a triangle are
/// neighbours.
struct FitMesh {
  std::vector<std::uint32_t> slotOfVertex;              ///< [vertex]
  std::vector<std::uint32_t> vertexOfSlot;              ///< [slot], one of its vertices
  std::vector<glm::vec3> positions;                     ///< [slot]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< [triangle], slots of its corners
  std::vector<std::uint32_t> rowStart;                  ///< [slot + 1], index into columns
  std::vector<std::uint32_t> columns;      ///< neighbours of each slot, ascending, without itself
  std::vector<std::uint32_t> cornerStart;  ///< [slot + 1], index into corners
  std::vector<std::uint32_t> corners;      ///< for each slot 3 x triangle + corner, ascending
  std::vector<std::uint32_t> components;   ///< [slot], the lowest slot of its connected component

  std::uint32_t slotCount() const { return static_cast<std::uint32_t>(vertexOfSlot.size()); }
};

/// Makes the mesh. Vertices with different `classes`, [vertex] or empty, do not share a slot.
FitMesh makeFitMesh(const CompiledScene& scene, std::span<const std::uint32_t> classes = {});

}  // namespace prelight
