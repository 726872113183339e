#include "plot/basis_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/balloon.h"

namespace prelight::plot {
namespace {

constexpr int tile = 120, gap = 8;
constexpr Color zero{240, 240, 240};

}  // namespace

Drawing plotHarmonics(const EvaluateBasis& evaluate, int order) {
  const SphereGrid grid = makeSphereGrid(97, 193);
  const std::size_t count = static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
  std::vector<double> all(grid.directions.size() * count);
  for (std::size_t d = 0; d < grid.directions.size(); ++d)
    evaluate(grid.directions[d], order, std::span(all).subspan(d * count, count));
  Drawing drawing = blankDrawing((2 * order - 1) * tile, order * (tile + captionHeight));
  for (int l = 0; l < order; ++l)
    for (int m = -l; m <= l; ++m) {
      std::vector<double> values;
      double greatest = 0.0;
      for (std::size_t d = 0; d < grid.directions.size(); ++d) {
        values.push_back(all[d * count + static_cast<std::size_t>(l * (l + 1) + m)]);
        greatest = std::max(greatest, std::abs(values.back()));
      }
      const glm::ivec2 corner((order - 1 + m) * tile, l * (tile + captionHeight));
      // Each function fills its square: their maxima differ by a factor of four.
      drawBalloon(drawing, corner, tile, grid, values, greatest, UpAxis::Z);
      drawing.labels.push_back(
          {glm::dvec2(corner) + glm::dvec2(tile / 2, tile + 12), fmt::format("{}, {}", l, m)});
    }
  return drawing;
}

Drawing plotWavelets(int faceSize, const std::vector<double>& values) {
  const int texel = 96 / faceSize, side = faceSize * texel, texels = faceSize * faceSize;
  Drawing drawing = blankDrawing(faceSize * (side + gap) + gap, faceSize * (side + gap) + gap);
  for (int wavelet = 0; wavelet < texels; ++wavelet) {
    const glm::ivec2 corner(gap + wavelet % faceSize * (side + gap), gap + wavelet / faceSize * (side + gap));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double value =
            values[static_cast<std::size_t>(wavelet * texels + y / texel * faceSize + x / texel)];
        drawing.set(corner.x + x, corner.y + y,
                    value > 0.0   ? positiveColor
                    : value < 0.0 ? negativeColor
                                  : zero);
      }
  }
  return drawing;
}

}  // namespace prelight::plot
