#include "export/map_picture.h"

#include <algorithm>
#include <cstddef>

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

}  // namespace prelight
