#include "gi/update/moved_boxes.h"

#include <algorithm>
#include <cmath>

namespace prelight {

namespace {

constexpr std::size_t mostBoxes = 64;
constexpr float widening = 1e-5f;  // relative to the largest coordinate; more than a hit's rounding

void widen(Box& box) {
  const glm::vec3 size = glm::max(glm::abs(box.lower), glm::abs(box.upper));
  const glm::vec3 by(widening * std::max({size.x, size.y, size.z}));
  box.lower -= by;
  box.upper += by;
}

}  // namespace

std::vector<Box> boxesAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const bool goesOn = i > 0 && triangles[i] == triangles[i - 1] + 1;
    if (!goesOn && boxes.size() < mostBoxes) boxes.emplace_back();
    for (int k = 0; k < 3; ++k) boxes.back().grow(scene.positions[scene.triangles[triangles[i]][k]]);
  }
  for (Box& box : boxes) widen(box);
  return boxes;
}

bool mayMeet(const device::Ray& ray, const Box& box) {
  float near = 0.0f, far = ray.tMax;
  for (int k = 0; k < 3; ++k) {
    const float inverse = 1.0f / ray.direction[k];
    float a = (box.lower[k] - ray.origin[k]) * inverse, b = (box.upper[k] - ray.origin[k]) * inverse;
    if (std::isnan(a) || std::isnan(b)) continue;  // in the plane of a side
    if (a > b) std::swap(a, b);
    near = std::max(near, a * (1.0f - 1e-6f));
    far = std::min(far, b * (1.0f + 1e-6f));
  }
  return near <= far;
}

}  // namespace prelight
