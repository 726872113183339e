#include "plot/basis_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "basis/haar.h"
#include "plot/balloon.h"
#include "prelight/error.h"

namespace prelight::plot {
namespace {

constexpr int tile = 120, gap = 8;
constexpr Color zero{240, 240, 240};

}  // namespace

Drawing plotHarmonics(HarmonicBasis basis, int order) {
  const SphereGrid grid = makeSphereGrid(97, 193);
  const std::vector<double> all = basisValues(basis, grid.directions, order);
  const std::size_t count = static_cast<std::size_t>(order) * order;
  double scale = 0.0;
  for (const double value : all) scale = std::max(scale, std::abs(value));
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

Drawing plotWavelets(int faceSize) {
  if (faceSize != 2 && faceSize != 4 && faceSize != 8)
    throw UsageError("face size", fmt::format("got {}, expected 2, 4 or 8", faceSize));
  const int texel = 96 / faceSize, side = faceSize * texel;
  Drawing drawing = blankDrawing(faceSize * (side + gap) + gap, faceSize * (side + gap) + gap);
  for (int row = 0; row < faceSize; ++row)
    for (int column = 0; column < faceSize; ++column) {
      const haar::Wavelet wavelet =
          haar::waveletOf(static_cast<std::uint32_t>(row * faceSize + column), faceSize);
      const glm::ivec2 corner(gap + column * (side + gap), gap + row * (side + gap));
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const double value = haar::valueAt(wavelet, y / texel, x / texel);
          drawing.set(corner.x + x, corner.y + y,
                      value > 0.0   ? positiveColor
                      : value < 0.0 ? negativeColor
                                    : zero);
        }
    }
  return drawing;
}

}  // namespace prelight::plot
