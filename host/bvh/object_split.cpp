#include "bvh/object_split.h"

#include <cmath>

namespace prelight {

double sharedHalfArea(const LaneBox& a, const LaneBox& b) {
  const Box shared = intersect(a.box(), b.box());
  return glm::all(glm::lessThanEqual(shared.lower, shared.upper)) ? shared.halfArea() : 0.0;
}

BinGrid::BinGrid(const LaneBox& centres, int bins)
    : bins_(bins), last_(Lanes{} + static_cast<float>(bins - 1)) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float extent = centres.upper[axis] - centres.lower[axis];
    const float scale = static_cast<float>(bins) / extent;
    origin_[axis] = centres.lower[axis];
    scale_[axis] = extent > 0.0f && std::isfinite(extent) && std::isfinite(scale) ? scale : 0.0f;
  }
}

}  // namespace prelight
