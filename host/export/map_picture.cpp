#include "export/map_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "charts/hidden_light.h"
#include "charts/light_map_lookup.h"
#include "charts/texel_grid.h"
#include "techniques/light_map/light_map_file.h"

namespace prelight {

namespace {

/// A level of the pyramid. Weights are 0 where no values are known.
struct Level {
  std::size_t width = 0, height = 0;
  std::vector<glm::dvec3> values;  ///< [row][column], times the weight
  std::vector<double> weights;
};

/// Returns a level of half the size, rounded up. Each texel is the sum of up to four.
Level pull(const Level& fine) {
  Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
  coarse.values.assign(coarse.width * coarse.height, glm::dvec3(0.0));
  coarse.weights.assign(coarse.width * coarse.height, 0.0);
  for (std::size_t y = 0; y < fine.height; ++y)
    for (std::size_t x = 0; x < fine.width; ++x) {
      const std::size_t at = y / 2 * coarse.width + x / 2;
      coarse.values[at] += fine.values[y * fine.width + x];
      coarse.weights[at] += fine.weights[y * fine.width + x];
    }
  // Weights are limited to 1.
  for (std::size_t at = 0; at < coarse.weights.size(); ++at) {
    if (coarse.weights[at] <= 1.0) continue;
    coarse.values[at] /= coarse.weights[at];
    coarse.weights[at] = 1.0;
  }
  return coarse;
}

/// Fills unknown texels from the coarser level, which is filled everywhere.
void push(const Level& coarse, Level& fine) {
  for (std::size_t y = 0; y < fine.height; ++y)
    for (std::size_t x = 0; x < fine.width; ++x) {
      const std::size_t at = y * fine.width + x, above = y / 2 * coarse.width + x / 2;
      const double missing = 1.0 - fine.weights[at];
      if (missing <= 0.0) continue;
      fine.values[at] += missing * coarse.values[above];
      fine.weights[at] = 1.0;
    }
}

}  // namespace

void fillEmptyTexels(Picture& picture, const std::vector<bool>& filled) {
  if (std::find(filled.begin(), filled.end(), true) == filled.end()) return;
  std::vector<Level> levels(1);
  levels[0] = {static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height), {}, {}};
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    levels[0].weights.push_back(filled[i] ? 1.0 : 0.0);
    levels[0].values.push_back(filled[i] ? glm::dvec3(picture.pixels[i]) : glm::dvec3(0.0));
  }
  while (levels.back().width * levels.back().height > 1) levels.push_back(pull(levels.back()));
  for (std::size_t i = levels.size() - 1; i > 0; --i) push(levels[i], levels[i - 1]);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (!filled[i]) picture.pixels[i] = glm::vec3(levels[0].values[i]);
}

std::vector<bool> metTexels(const LightMapLayout& layout) {
  std::vector<bool> met(layout.texelCount(), false);
  for (const LightMapTexel& texel : layout.texels) met[texel.texel] = true;
  return met;
}

Picture irradiancePicture(const LightMap& map) {
  Picture picture = irradianceOf(map);
  fillEmptyTexels(picture, metTexels(map.layout));
  return picture;
}

Picture occlusionPicture(const LightMap& map) {
  Picture picture = irradiancePicture(map);
  for (glm::vec3& pixel : picture.pixels) pixel = glm::clamp(pixel, 0.0f, 1.0f);
  return picture;
}

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
