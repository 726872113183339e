#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight::viewer {

/// Where rectangles lie in layers of one size.
struct ChartAtlas {
  struct Place {
    int layer = 0;
    int x = 0;  ///< of the upper left texel
    int y = 0;
  };
  int side = 0;  ///< of the square layers, texels
  int layers = 0;
  std::vector<Place> places;  ///< [rectangle]
};

/// Packs rectangles (width, height), each at least 1, into as many layers as they take. A layer is as large
/// as the largest rectangle or `usualSide`, whichever is more.
ChartAtlas packCharts(const std::vector<glm::ivec2>& sizes, int usualSide = 1024);

}  // namespace prelight::viewer
