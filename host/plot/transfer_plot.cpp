#include "plot/transfer_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plot/balloon.h"
#include "plot/sky_plots.h"
#include "prelight/error.h"

namespace prelight::plot {
namespace {

/// Returns the order of a row of 1 or 3 channels. No number is a square and three times a square.
int orderOf(std::size_t length) {
  for (int order = 1; order <= 32; ++order) {
    const std::size_t count = static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
    if (length == count || length == 3 * count) return order;
  }
  throw UsageError("transfer",
                   fmt::format("got {} coefficients, expected 1 or 3 channels of order^2", length));
}

std::vector<double> valuesOf(const TransferRow& transfer, const std::vector<glm::dvec3>& directions) {
  const int order = orderOf(transfer.row.size());
  const std::size_t count = static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
  std::vector<double> values, functions(count);
  for (const glm::dvec3& direction : directions) {
    transfer.evaluate(direction, order, functions);
    double sum = 0.0;
    for (std::size_t i = 0; i < transfer.row.size(); ++i) sum += transfer.row[i] * functions[i % count];
    values.push_back(sum * static_cast<double>(count) / static_cast<double>(transfer.row.size()));
  }
  return values;
}

/// Draws values as a map: white is the largest, black 0, and negative ones are violet.
void drawMap(Drawing& drawing, int left, const std::vector<double>& values) {
  const double greatest = std::max(*std::max_element(values.begin(), values.end()), 1e-12);
  for (int y = 0; y < mapHeight; ++y)
    for (int x = 0; x < mapWidth; ++x) {
      const double value =
          values[static_cast<std::size_t>(y) * mapWidth + static_cast<std::size_t>(x)] / greatest;
      const auto grey =
          static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(std::clamp(value, 0.0, 1.0))));
      drawing.set(left + x, y, value < -0.01 ? belowZeroColor : Color{grey, grey, grey});
    }
}

}  // namespace

Drawing plotTransfer(const TransferRow& transfer) {
  const SphereGrid grid = makeSphereGrid(129, 257);
  const std::vector<double> values = valuesOf(transfer, grid.directions);
  double greatest = 1e-12;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  Drawing drawing = blankDrawing(mapHeight + mapWidth, mapHeight + captionHeight);
  drawBalloon(drawing, {0, 0}, mapHeight, grid, values, greatest, UpAxis::Y);
  drawMap(drawing, mapHeight, valuesOf(transfer, directionsOfMap()));
  drawing.labels.push_back({{0.5 * (mapHeight + mapWidth), mapHeight + 14.0},
                            fmt::format("{}, order {}, at most {:.3g} per sr", transfer.name,
                                        orderOf(transfer.row.size()), greatest)});
  return drawing;
}

}  // namespace prelight::plot
