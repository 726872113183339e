#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace prelight {

/// The texels that a chart needs, within their bounding rectangle.
struct ChartMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells;  ///< [y][x], 1: needed
};

/// An atlas in which masks are packed, texels.
struct MaskPacking {
  int width = 0;
  int height = 0;
  std::vector<glm::ivec2> origins;  ///< [mask] position of its upper left texel
};

/// Packs masks so that no texel is used twice: the largest first, each at the first free place, row by row,
/// at the width that leaves the least area unused. Returns nothing when that takes more than `mostSide`
/// texels per side.
std::optional<MaskPacking> packMasks(std::span<const ChartMask> masks, int mostSide);

}  // namespace prelight
