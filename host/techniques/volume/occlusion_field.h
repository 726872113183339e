#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/progress.h"
#include "prelight/transfer.h"

namespace prelight {

struct OcclusionFieldOptions {
  double radius = 0.0;          ///< m, > 0; what is farther from a place hides nothing of its surroundings
  std::size_t cells = 1 << 15;  ///< of the grid, about
  std::uint32_t rays = 128;     ///< a cell, a power of two, 16 and more
  std::uint64_t seed = 0;
};

/// What an object hides of the surroundings of places about it: an ambient-occlusion field [1], in a grid as
/// in [2]. Cells within a solid take after those around it. [1] Kontkanen and Laine, "Ambient occlusion
/// fields", 2005. [2] Malmer et al., "Fast precomputed ambient occlusion for proximity shadows", 2007.
struct OcclusionField {
  static constexpr int order = 3;  ///< bands of SH
  static constexpr std::size_t moments = order * order;

  VolumeGrid grid;  ///< world space; around the object as far as the radius
  std::vector<float>
      hidden;  ///< [z][y][x][moments]: integral of Y_i over the directions that meet the object
};

/// Casts from the cells of a grid around all of `object`, which has a triangle.
OcclusionField castOcclusionField(const CompiledScene& object, const Device& device,
                                  const OcclusionFieldOptions& options, Progress& progress);

}  // namespace prelight
