#include "radiosity/elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "prelight/error.h"

namespace prelight {

namespace {

constexpr double usualElements = 8192.0;
constexpr double mostElements = double(1u << 28);

double longestEdge(const CompiledScene& scene, std::uint32_t triangle) {
  const auto& t = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

}  // namespace

std::uint32_t RadiosityElements::triangleOf(std::uint32_t element) const {
  const std::uint32_t piece = element % perSide();
  return static_cast<std::uint32_t>(std::upper_bound(first.begin(), first.end(), piece) - first.begin()) - 1;
}

double defaultPatchSize(const CompiledScene& scene) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    area += 0.5 * glm::length(geometricNormal(scene, t));
  // This is the longest edge of half a square of the mean area of an element.
  return 2.0 * std::sqrt(area / usualElements);
}

RadiosityElements makeElements(const CompiledScene& scene, double patchSize) {
  RadiosityElements elements;
  elements.first.push_back(0);
  double count = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double splits = std::max(1.0, std::ceil(longestEdge(scene, t) / patchSize - 1e-6));
    count += splits * splits;
    if (count > mostElements)
      throw UsageError(
          "RadiosityRequest::patchSize",
          fmt::format("{} m makes more than {:.0f} elements of this scene", patchSize, mostElements),
          "take larger patches");
    elements.splits.push_back(static_cast<std::uint32_t>(splits));
    elements.first.push_back(static_cast<std::uint32_t>(count));
    elements.areas.push_back(
        static_cast<float>(0.5 * glm::length(geometricNormal(scene, t)) / (splits * splits)));
  }
  return elements;
}

std::uint32_t pieceAt(std::uint32_t splits, double u, double v) {
  if (splits == 1) return 0;
  const double x = u * splits, y = v * splits;
  const auto row = std::min(splits - 1, static_cast<std::uint32_t>(std::max(0.0, y)));
  const auto column = std::min(splits - 1 - row, static_cast<std::uint32_t>(std::max(0.0, x)));
  const bool inverted = column + row + 1 < splits && (x - column) + (y - row) > 1.0;
  return row * (2 * splits - row) + 2 * column + (inverted ? 1 : 0);
}

glm::dvec2 pointOfPiece(std::uint32_t splits, std::uint32_t piece, const glm::dvec2& inPiece) {
  // Row r starts at piece r (2 splits - r).
  const double n = splits;
  auto row = static_cast<std::uint32_t>(n - std::sqrt(std::max(0.0, n * n - piece)));
  while (row > 0 && row * (2 * splits - row) > piece) --row;
  while ((row + 1) * (2 * splits - row - 1) <= piece) ++row;
  const std::uint32_t place = piece - row * (2 * splits - row);
  const glm::dvec2 corner(place / 2, row);
  const glm::dvec2 at = place % 2 == 0 ? corner + inPiece : corner + 1.0 - inPiece;
  return at / n;
}

}  // namespace prelight
