#include "plot/transfer_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "basis/cube_map.h"
#include "basis/haar.h"
#include "plot/balloon.h"
#include "plot/sky_plots.h"
#include "prelight/basis.h"
#include "prelight/error.h"

namespace prelight::plot {
namespace {

void requireVertex(std::uint32_t vertex, std::size_t count) {
  if (vertex >= count)
    throw UsageError("--vertex", fmt::format("got {}, expected at most {}: the bake has {} vertices", vertex,
                                             count - 1, count));
}

/// Returns the values of a vertex' transfer in directions.
std::vector<double> valuesOf(const HarmonicTransfer& transfer, HarmonicBasis basis, std::uint32_t vertex,
                             const std::vector<glm::dvec3>& directions) {
  const std::size_t count = static_cast<std::size_t>(transfer.order) * transfer.order,
                    channels = transfer.channels;
  const std::vector<double> functions = basisValues(basis, directions, transfer.order);
  std::vector<double> values(directions.size());
  for (std::size_t d = 0; d < directions.size(); ++d)
    for (std::size_t i = 0; i < channels * count; ++i)
      values[d] += transfer.coefficients[vertex * channels * count + i] * functions[d * count + i % count] /
                   static_cast<double>(channels);
  return values;
}

std::vector<double> valuesOf(const HaarTransfer& transfer, std::uint32_t vertex,
                             const std::vector<glm::dvec3>& directions) {
  std::vector<double> texels(cubeTexelCount(transfer.faceSize));
  const std::size_t channels = transfer.channels;
  for (std::size_t row = vertex * channels; row < (vertex + 1) * channels; ++row)
    for (std::size_t i = transfer.offsets[row]; i < transfer.offsets[row + 1]; ++i)
      texels[transfer.indices[i]] += transfer.values[i] / static_cast<double>(channels);
  haar::inverse(texels, transfer.faceSize);
  const CubeTexels cube(transfer.faceSize);
  std::vector<double> values;
  for (const glm::dvec3& direction : directions) {
    const std::uint32_t texel = cubeTexel(direction, transfer.faceSize);
    values.push_back(texels[texel] /
                     cube.solidAngle(texel));  // the transfer of a texel is an integral over it
  }
  return values;
}

/// Draws values as a map: white is the largest, black 0, and negative ones are violet.
void drawMap(Drawing& drawing, int left, const std::vector<double>& values) {
  const double greatest = std::max(*std::max_element(values.begin(), values.end()), 1e-12);
  for (int y = 0; y < mapHeight; ++y)
    for (int x = 0; x < mapWidth; ++x) {
      const double value = values[static_cast<std::size_t>(y) * mapWidth + x] / greatest;
      const auto grey =
          static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::clamp(value, 0.0, 1.0))));
      drawing.set(left + x, y, value < -0.01 ? belowZeroColor : Color{grey, grey, grey});
    }
}

Drawing plotSeries(const HarmonicTransfer& transfer, HarmonicBasis basis, std::uint32_t vertex) {
  const std::size_t rowLength = static_cast<std::size_t>(transfer.channels) * transfer.order * transfer.order;
  requireVertex(vertex, transfer.coefficients.size() / rowLength);
  const SphereGrid grid = makeSphereGrid(129, 257);
  const std::vector<double> values = valuesOf(transfer, basis, vertex, grid.directions);
  double greatest = 1e-12;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  Drawing drawing = blankDrawing(mapHeight + mapWidth, mapHeight + captionHeight);
  drawBalloon(drawing, {0, 0}, mapHeight, grid, values, greatest, UpAxis::Y);
  drawMap(drawing, mapHeight, valuesOf(transfer, basis, vertex, directionsOfMap()));
  drawing.labels.push_back({{0.5 * (mapHeight + mapWidth), mapHeight + 14.0},
                            fmt::format("transfer of vertex {}, order {}, at most {:.3g} per sr", vertex,
                                        transfer.order, greatest)});
  return drawing;
}

Drawing plotWavelets(const HaarTransfer& transfer, std::uint32_t vertex) {
  requireVertex(vertex, (transfer.offsets.size() - 1) / transfer.channels);
  Drawing drawing = blankDrawing(mapWidth, mapHeight + captionHeight);
  drawMap(drawing, 0, valuesOf(transfer, vertex, directionsOfMap()));
  const std::size_t channels = transfer.channels;
  drawing.labels.push_back(
      {{0.5 * mapWidth, mapHeight + 14.0},
       fmt::format(
           "transfer of vertex {}, {} wavelets", vertex,
           (transfer.offsets[(vertex + 1) * channels] - transfer.offsets[vertex * channels]) / channels)});
  return drawing;
}

}  // namespace

Drawing plotTransfer(const Bake& bake, std::uint32_t vertex) {
  if (bake.sh) return plotSeries(*bake.sh, HarmonicBasis::Sh, vertex);
  if (bake.compressedSh) return plotSeries(decompress(*bake.compressedSh), HarmonicBasis::Sh, vertex);
  if (bake.ch) return plotSeries(*bake.ch, HarmonicBasis::Ch, vertex);
  if (bake.haar) return plotWavelets(*bake.haar, vertex);
  throw UsageError("plot transfer", "the bake has no transfer", "bake it with --sh, --ch or --haar");
}

}  // namespace prelight::plot
