#include "viewer/techniques/caustics/caustic_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prelight::viewer {
namespace {

/// Points this much farther from the picture's centre than its border count, as their light may reach into
/// it.
constexpr float seenBeyondBorder = 1.2f;

int floorTo(int value, int step) {
  const int rest = value % step;
  return value - (rest < 0 ? rest + step : rest);
}

/// Returns the least depth of the points that are seen, m; infinite if none is.
double nearestDepth(std::span<const glm::vec3> points, const CameraMatrices& camera) {
  const glm::mat4 clipFromScene(camera.projection * camera.view);
  float least = std::numeric_limits<float>::infinity();
  for (const glm::vec3& point : points) {
    const glm::vec4 clip = clipFromScene * glm::vec4(point, 1.0f);
    if (clip.w > 0.0f && std::max(std::abs(clip.x), std::abs(clip.y)) < seenBeyondBorder * clip.w)
      least = std::min(least, clip.w);
  }
  return static_cast<double>(least);
}

}  // namespace

Tile LevelRaster::tile(int pictureHeight) const {
  const int side = pixelsPerTexel(level);
  return {left, pictureHeight - bottom - side * height, side * width, side * height};
}

LevelRaster rasterAround(const Tile& tile, int pictureHeight, int level, int margin) {
  const int side = pixelsPerTexel(level);
  const int bottom = pictureHeight - tile.y - tile.height;
  LevelRaster raster;
  raster.level = level;
  raster.left = floorTo(tile.x, side) - margin * side;
  raster.bottom = floorTo(bottom, side) - margin * side;
  raster.width = (tile.x + tile.width - raster.left + side - 1) / side + margin;
  raster.height = (bottom + tile.height - raster.bottom + side - 1) / side + margin;
  return raster;
}

int levelsForRadius(std::span<const glm::vec3> points, double radius, const CameraMatrices& camera,
                    double pixelWidth, int margin, int most) {
  const double depth = camera.perspective ? nearestDepth(points, camera) : 1.0;
  const double pixels = radius / (pixelWidth * depth);
  int levels = 1;
  while (levels < most && pixels > margin * pixelsPerTexel(levels - 1)) ++levels;
  return levels;
}

}  // namespace prelight::viewer
