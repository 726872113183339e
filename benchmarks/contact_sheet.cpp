#include "benchmarks/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace prelight::benchmarks {

namespace {

constexpr int mostColumns = 4;
constexpr int leastWidth = 240, mostWidth = 320;  // of a picture; its text takes the least
constexpr double gap = 8.0;
constexpr double titleHeight = 34.0;
constexpr double labelHeight = 42.0;
constexpr std::string_view quiet = "#6b7178";

struct Cell {
  std::string name;
  std::string errors;
  std::string costs;
  std::span<const glm::vec3> picture;
};

std::vector<Cell> cellsOf(const SceneComparison& scene) {
  std::vector<Cell> cells = {
      {"path traced", fmt::format("own error: FLIP {:.3f}, RMSE {:.4f}", scene.truth.flip, scene.truth.rmse),
       fmt::format("{} samples, {:.3g} s", samplesText(scene.truth), scene.truth.seconds),
       scene.truth.displayed}};
  for (const TechniqueResult& row : scene.techniques)
    cells.push_back({row.name, fmt::format("FLIP {:.3f}, RMSE {:.4f}", row.flip, row.error.rmse),
                     fmt::format("{:.3g} s, {:.3g} MB, {:.0f} ms", row.firstPass + row.secondPass,
                                 static_cast<double>(row.bytes) * 1e-6, 1e3 * row.frameSeconds),
                     row.displayed});
  return cells;
}

/// Share of the pixel `i` that lies in [from, to).
double overlap(int i, double from, double to) {
  return std::max(0.0, std::min(to, i + 1.0) - std::max(from, static_cast<double>(i)));
}

}  // namespace

std::vector<glm::vec3> shrink(std::span<const glm::vec3> pixels, int width, int height, int newWidth) {
  const int newHeight = std::max(1, height * newWidth / width);
  const double stepX = static_cast<double>(width) / newWidth, stepY = static_cast<double>(height) / newHeight;
  std::vector<glm::vec3> result;
  for (int y = 0; y < newHeight; ++y)
    for (int x = 0; x < newWidth; ++x) {
      glm::dvec3 sum(0.0);
      double total = 0.0;
      for (int j = static_cast<int>(y * stepY); j < height && j < (y + 1) * stepY; ++j)
        for (int i = static_cast<int>(x * stepX); i < width && i < (x + 1) * stepX; ++i) {
          const double weight =
              overlap(i, x * stepX, (x + 1) * stepX) * overlap(j, y * stepY, (y + 1) * stepY);
          sum += weight * glm::dvec3(pixels[static_cast<std::size_t>(j) * width + i]);
          total += weight;
        }
      result.emplace_back(sum / total);
    }
  return result;
}

Canvas drawContactSheet(const SceneComparison& scene) {
  const std::vector<Cell> cells = cellsOf(scene);
  const int width = std::min(scene.width, mostWidth);
  const int height = std::max(1, scene.height * width / scene.width);
  const int cellWidth = std::max(width, leastWidth);
  const auto count = static_cast<int>(cells.size());
  const int rows = (count + mostColumns - 1) / mostColumns, columns = (count + rows - 1) / rows;
  Canvas sheet(gap + columns * (cellWidth + gap), titleHeight + rows * (height + labelHeight + gap));
  sheet.text({gap, 21.0},
             fmt::format("{}: {} vertices, {}, {} x {}", scene.name, scene.vertices, scene.light, scene.width,
                         scene.height),
             {.size = 13, .color = "#202124", .bold = true});
  for (int i = 0; i < count; ++i) {
    const Cell& cell = cells[static_cast<std::size_t>(i)];
    const double x = gap + i % columns * (cellWidth + gap);
    const double y = titleHeight + static_cast<double>(i / columns) * (height + labelHeight + gap);
    sheet.picture({x, y}, shrink(cell.picture, scene.width, scene.height, width), width);
    sheet.text({x, y + height + 13.0}, cell.name, {.size = 13, .color = "#202124", .bold = true});
    sheet.text({x, y + height + 26.0}, cell.errors, {.size = 13, .color = quiet});
    sheet.text({x, y + height + 39.0}, cell.costs, {.size = 13, .color = quiet});
  }
  return sheet;
}

}  // namespace prelight::benchmarks
