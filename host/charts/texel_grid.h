#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/light_map.h"

namespace prelight {

/// The texels of a layout by their position on the map.
class TexelGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  /// The layout must outlive this object.
  explicit TexelGrid(const LightMapLayout& layout) : layout_(layout), at_(layout.texelCount(), none) {
    for (std::uint32_t i = 0; i < layout.texels.size(); ++i) at_[layout.texels[i].texel] = i;
  }

  /// Returns column and row of a texel of the map.
  glm::ivec2 positionOf(std::uint32_t texel) const {
    const auto width = static_cast<std::uint32_t>(layout_.width);
    return {texel % width, texel / width};
  }

  /// Returns the index among the layout's texels for a texel of the map, or none.
  std::uint32_t indexOf(std::uint32_t texel) const { return at_[texel]; }

  /// Returns the index of the texel of the same chart at a step from texel i of the layout, or none.
  std::uint32_t neighbour(std::uint32_t i, const glm::ivec2& step) const {
    const glm::ivec2 p = positionOf(layout_.texels[i].texel) + step;
    if (p.x < 0 || p.y < 0 || p.x >= layout_.width || p.y >= layout_.height) return none;
    const std::uint32_t other = at_[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(layout_.width) +
                                    static_cast<std::size_t>(p.x)];
    return other != none && chartOf(other) == chartOf(i) ? other : none;
  }

  /// Calls visit(other, step) for the up to eight texels of its chart around texel i.
  template <typename Visit>
  void forNeighbours(std::uint32_t i, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::uint32_t other = neighbour(i, {dx, dy});
        if (other != none) visit(other, glm::ivec2(dx, dy));
      }
  }

 private:
  std::uint32_t chartOf(std::uint32_t i) const { return layout_.chartOf[layout_.texels[i].face]; }

  const LightMapLayout& layout_;
  std::vector<std::uint32_t> at_;  ///< [texel of the map]
};

}  // namespace prelight
