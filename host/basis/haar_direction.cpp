#include "basis/haar_direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace prelight::haar {
namespace {

/// Faces with fewer texels are interpolated as they are, since their texels are wide enough.
constexpr int leastBlocked = 16;

using Coefficient = std::pair<std::uint32_t, double>;

/// Adds the coefficients of a function that is `value` on the block of `size` texels at (row, column) of a
/// face and 0 elsewhere.
void addBlock(int face, int row, int column, int size, int faceSize, double value,
              std::vector<Coefficient>& sum) {
  const auto at = [&](int r, int c) {
    return static_cast<std::uint32_t>((face * faceSize + r) * faceSize + c);
  };
  const double whole = value * size * size;
  for (int half = size; half < faceSize; half *= 2) {
    const int top = row & ~(2 * half - 1), left = column & ~(2 * half - 1);
    const double detail = whole / (2 * half);
    const double across = (column & half) == 0 ? detail : -detail;
    const double down = (row & half) == 0 ? 1.0 : -1.0;
    sum.emplace_back(at(top, left + half), across);
    sum.emplace_back(at(top + half, left), down * detail);
    sum.emplace_back(at(top + half, left + half), down * across);
  }
  sum.emplace_back(at(0, 0), whole / faceSize);
}

SparseRow joined(std::vector<Coefficient> coefficients) {
  std::sort(coefficients.begin(), coefficients.end());
  SparseRow row;
  double sum = 0.0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    sum += coefficients[k].second;
    if (k + 1 < coefficients.size() && coefficients[k + 1].first == coefficients[k].first) continue;
    if (const double value = std::exchange(sum, 0.0); value != 0.0) {
      row.indices.push_back(coefficients[k].first);
      row.values.push_back(static_cast<float>(value));
    }
  }
  return row;
}

}  // namespace

DirectionFilter::DirectionFilter(int faceSize)
    : faceSize_(faceSize), blockSize_(faceSize >= leastBlocked ? 2 : 1), blocks_(faceSize / blockSize_) {}

DirectionFilter::Light DirectionFilter::towards(const glm::dvec3& direction, const glm::dvec3& normal) const {
  const int side = faceSize_ / blockSize_;
  const auto face = static_cast<int>(cubeTexel(direction, 1));
  const CubeFace& frame = cubeFace(face);
  const double along = glm::dot(direction, frame.axis);
  const glm::dvec2 place =
      glm::dvec2(glm::dot(direction, frame.right), glm::dot(direction, frame.down)) / along;
  const glm::dvec2 between = 0.5 * (place + 1.0) * double(side) - 0.5, lower = glm::floor(between);
  Light light;
  std::vector<Coefficient> sum;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::ivec2 step(corner % 2, corner / 2);
    const glm::ivec2 block = glm::clamp(glm::ivec2(lower) + step, 0, side - 1);
    const glm::dvec2 shares = glm::mix(1.0 - (between - lower), between - lower, glm::dvec2(step));
    const double weight = shares.x * shares.y;
    if (weight == 0.0) continue;
    const auto texel = static_cast<std::uint32_t>((face * side + block.y) * side + block.x);
    addBlock(face, blockSize_ * block.y, blockSize_ * block.x, blockSize_, faceSize_,
             weight / blocks_.solidAngle(texel), sum);
    light.open +=
        weight * std::max(glm::dot(normal, cubeTexelDirection(texel, side)), 0.0) / std::numbers::pi;
  }
  light.coefficients = joined(std::move(sum));
  return light;
}

}  // namespace prelight::haar
