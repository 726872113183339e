#pragma once

#include <glm/glm.hpp>
#include <span>

#include "viewer/core/camera.h"
#include "viewer/core/view_state.h"

namespace prelight::viewer {

/// Pixels per texel of a level's side: 1, 2, 4, ... for levels 0, 1, 2, ...
constexpr int pixelsPerTexel(int level) { return 1 << level; }

/// The raster of one level of a caustic filter: a tile and what the filter looks at around it, in texels of
/// the level. Rasters of all tiles lie on one grid per level, so that tiles meet without seams.
struct LevelRaster {
  int level = 0;
  int left = 0;    ///< pixels from the picture's left border
  int bottom = 0;  ///< pixels from the picture's bottom border
  int width = 0;   ///< texels
  int height = 0;  ///< texels

  /// The part of a picture of the given height, in pixels, that the raster covers.
  Tile tile(int pictureHeight) const;
};

/// Returns the raster of a level around a tile with `margin` texels or more on every side.
LevelRaster rasterAround(const Tile& tile, int pictureHeight, int level, int margin);

/// Returns how many levels a filter needs so that `radius`, in metres, spans at most `margin` texels of the
/// coarsest level wherever one of the points is seen: 1 to `most`. `pixelWidth` is the width of a pixel at
/// unit depth, or anywhere for an orthographic camera, m.
int levelsForRadius(std::span<const glm::vec3> points, double radius, const CameraMatrices& camera,
                    double pixelWidth, int margin, int most);

}  // namespace prelight::viewer
