#include "export/plain_map.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "charts/hidden_light.h"
#include "charts/texel_grid.h"
#include "charts/walled_square.h"

namespace prelight {

namespace {

class WallRemover {
 public:
  explicit WallRemover(const LightMap& map)
      : map_(map), length_(3 * static_cast<std::size_t>(map.coefficients)), grid_(map.layout) {}

  LightMap remove() {
    for (const LightMapTexel& texel : map_.layout.texels) darkest_.push_back(texel.texel);
    for (int y = 0; y + 1 < map_.layout.height; ++y)
      for (int x = 0; x + 1 < map_.layout.width; ++x) lookAt(x, y);
    LightMap plain = map_;
    plain.layout.walls.clear();
    for (std::size_t i = 0; i < darkest_.size(); ++i)
      std::copy_n(&map_.values[length_ * darkest_[i]], length_,
                  &plain.values[length_ * map_.layout.texels[i].texel]);
    return plain;
  }

 private:
  double lightAt(std::uint32_t texel) const {
    return lightOf(std::span(map_.values).subspan(length_ * texel, length_));
  }

  /// Compares each texel of a square with walls with those on the other sides.
  void lookAt(int x, int y) {
    const SquareWalls walls = wallsOf(map_.layout, x, y);
    if (!walls.any()) return;
    std::array<std::uint32_t, 4> texels{};
    for (int i = 0; i < 4; ++i)
      texels[static_cast<std::size_t>(i)] =
          static_cast<std::uint32_t>((y + i / 2) * map_.layout.width + x + i % 2);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t own = grid_.indexOf(texels[i]);
      if (own == TexelGrid::none) continue;
      const glm::dvec2 place(static_cast<double>(i % 2), static_cast<double>(i / 2));
      for (const bool wide : {true, false}) {
        const std::array<double, 4> side = walledWeights(walls, place, wide);
        for (std::size_t k = 0; k < 4; ++k)
          if (side[k] == 0.0 && counts(texels[k], own) && lightAt(texels[k]) < lightAt(darkest_[own]))
            darkest_[own] = texels[k];
      }
    }
  }

  /// Returns whether look-ups read a texel, and on the same chart.
  bool counts(std::uint32_t texel, std::uint32_t beside) const {
    const std::uint32_t index = grid_.indexOf(texel);
    const LightMapLayout& layout = map_.layout;
    return index != TexelGrid::none && !layout.walls[texel].inside &&
           layout.chartOf[layout.texels[index].face] == layout.chartOf[layout.texels[beside].face];
  }

  const LightMap& map_;
  std::size_t length_;
  TexelGrid grid_;
  std::vector<std::uint32_t> darkest_;  ///< [texel of the layout], texel of the map with the darkest light
};

}  // namespace

LightMap withoutWalls(const LightMap& map) {
  return map.layout.walls.empty() ? map : WallRemover(map).remove();
}

}  // namespace prelight
