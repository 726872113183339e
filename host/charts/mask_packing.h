#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace prelight {

/// Texels that a chart needs, of the rectangle around them.
struct ChartMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells;  ///< [y][x], 1: needed
};

struct MaskPacking {
  int width = 0;
  int height = 0;
  std::vector<glm::ivec2> origins;  ///< [mask], of its upper left texel
};

/// Packs masks so that no texel is needed twice: from the largest down, each at the first place that is free,
/// row by row, at the width that leaves the least of the area unused. Nothing when that takes more than
/// `mostSide` texels a side.
std::optional<MaskPacking> packMasks(std::span<const ChartMask> masks, int mostSide);

}  // namespace prelight
