#include "viewer/scene/triangle_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prelight::viewer {
namespace {

/// The tolerance, as a share of the sizes of the terms: far above the rounding of their sum.
constexpr float roundingShare = 1e-5f;

/// The largest value of dot(plane, (p, 1)) over the points of a box, and a little more.
float largestOver(const glm::vec3& lower, const glm::vec3& upper, const glm::vec4& plane) {
  float sum = plane.w, sizes = std::abs(plane.w);
  for (int k = 0; k < 3; ++k) {
    const float term = std::max(plane[k] * lower[k], plane[k] * upper[k]);
    sum += term;
    sizes += std::max(std::abs(plane[k] * lower[k]), std::abs(plane[k] * upper[k]));
  }
  return sum + roundingShare * sizes;
}

}  // namespace

TriangleBlocks::TriangleBlocks(const CompiledScene& compiled)
    : bounds_((compiled.triangleCount() + trianglesOfABlock - 1) / trianglesOfABlock) {
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
    Bounds& block = bounds_[t / trianglesOfABlock];
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& corner = compiled.positions[compiled.triangles[t][k]];
      block.lower = glm::min(block.lower, corner);
      block.upper = glm::max(block.upper, corner);
    }
  }
}

std::vector<bool> TriangleBlocks::shownBy(const glm::mat4& clipFromScene) const {
  const glm::mat4 rows = glm::transpose(clipFromScene);
  const std::array<glm::vec4, 5> sides = {rows[3], rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                          rows[3] - rows[1]};
  std::vector<bool> shown;
  for (const Bounds& bounds : bounds_)
    shown.push_back(std::ranges::all_of(
        sides, [&](const glm::vec4& side) { return largestOver(bounds.lower, bounds.upper, side) >= 0.0f; }));
  return shown;
}

void ShownTriangles::forEach(const TriangleRange& range,
                             const std::function<void(const TriangleRange&)>& draw) const {
  const std::uint32_t end = range.first + range.count, size = TriangleBlocks::trianglesOfABlock;
  for (std::uint32_t first = range.first; first < end;) {
    const auto isShown = [&](std::uint32_t triangle) { return shown_[triangle / size]; };
    const auto nextBlock = [&](std::uint32_t triangle) { return (triangle / size + 1) * size; };
    std::uint32_t next = nextBlock(first);
    while (next < end && isShown(next) == isShown(first)) next = nextBlock(next);
    next = std::min(next, end);
    if (isShown(first)) draw({first, next - first});
    first = next;
  }
}

}  // namespace prelight::viewer
