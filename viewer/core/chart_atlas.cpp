#include "viewer/core/chart_atlas.h"

#include <algorithm>
#include <numeric>

namespace prelight::viewer {

// Shelves: from the tallest rectangle down, side by side, row by row.
ChartAtlas packCharts(const std::vector<glm::ivec2>& sizes, int usualSide) {
  ChartAtlas atlas;
  atlas.places.resize(sizes.size());
  if (sizes.empty()) return atlas;
  atlas.side = usualSide;
  for (const glm::ivec2& size : sizes) atlas.side = std::max({atlas.side, size.x, size.y});
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a].y > sizes[b].y; });
  int layer = 0, x = 0, y = 0, shelf = 0;
  for (const std::size_t i : order) {
    if (x + sizes[i].x > atlas.side) {
      y += shelf;
      x = shelf = 0;
    }
    if (y + sizes[i].y > atlas.side) {
      ++layer;
      x = y = shelf = 0;
    }
    atlas.places[i] = {layer, x, y};
    x += sizes[i].x;
    shelf = std::max(shelf, sizes[i].y);
  }
  atlas.layers = layer + 1;
  return atlas;
}

}  // namespace prelight::viewer
