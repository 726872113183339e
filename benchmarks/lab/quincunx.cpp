#include "benchmarks/lab/quincunx.h"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "basis/cube_map.h"
#include "prelight/error.h"

// [1] Sweldens, "The lifting scheme: a construction of second generation wavelets", 1998: predict, then
// update.

namespace prelight {
namespace {

int checkIntervals(int intervals) {
  if (intervals >= 2 && intervals <= 512 && std::has_single_bit(static_cast<unsigned>(intervals)))
    return intervals;
  throw UsageError("quincunx lattice",
                   fmt::format("got {} intervals, expected a power of two from 2 to 512", intervals));
}

bool onFace(int coordinate, int n) { return coordinate == 0 || coordinate == n; }

/// Returns whether two points share a face: a coordinate of both is at the same end of the cube.
bool shareFace(const glm::ivec3& p, const glm::ivec3& q, int n) {
  for (int k = 0; k < 3; ++k) {
    if (p[k] == q[k] && onFace(p[k], n)) return true;
  }
  return false;
}

bool inside(const glm::ivec3& p, int n) {
  return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= n && p.y <= n && p.z <= n;
}

/// Calls visit(neighbour) for the points at a distance of a stride along one axis, or along two.
template <typename Visit>
void forNeighbours(const glm::ivec3& place, int n, int stride, bool diagonal, Visit visit) {
  for (int step = 0; step < 27; ++step) {
    const glm::ivec3 direction(step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1);
    const int axes = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    const glm::ivec3 neighbour = place + stride * direction;
    if (axes == (diagonal ? 2 : 1) && inside(neighbour, n) && shareFace(place, neighbour, n))
      visit(neighbour);
  }
}

/// Returns true for points that a step predicts, false for those that it keeps or that earlier steps
/// predicted.
bool isOdd(const glm::ivec3& place, int stride, bool diagonal) {
  if (place.x % stride != 0 || place.y % stride != 0 || place.z % stride != 0) return false;
  const glm::ivec3 unit = place / stride;
  const bool oddSum = (unit.x + unit.y + unit.z) % 2 != 0;
  return diagonal ? !oddSum && (unit.x % 2 != 0 || unit.y % 2 != 0 || unit.z % 2 != 0) : oddSum;
}

}  // namespace

QuincunxLattice::QuincunxLattice(int intervals) : intervals_(checkIntervals(intervals)) {
  const auto n = static_cast<std::size_t>(intervals);
  solidAngles_.assign(6 * n * n + 2, 0.0);
  const CubeTexels texels(2 * intervals);
  for (std::uint32_t texel = 0; texel < texels.count(); ++texel) {
    solidAngles_[pointOf(texel)] += texels.solidAngle(texel);
  }
  const std::vector<glm::ivec3> all = places();
  std::vector<double> integrals = solidAngles_;
  for (int stride = 1; stride < intervals; stride *= 2) {
    addStep(stride, false, all, integrals);
    addStep(stride, true, all, integrals);
  }
}

std::uint32_t QuincunxLattice::pointAt(const glm::ivec3& p) const {
  const int n = intervals_, layer = (n + 1) * (n + 1);
  if (p.z == 0) return static_cast<std::uint32_t>(p.y * (n + 1) + p.x);
  const int ring = layer + (p.z - 1) * 4 * n;
  if (p.z == n) return static_cast<std::uint32_t>(ring + p.y * (n + 1) + p.x);
  if (p.y == 0 && p.x < n) return static_cast<std::uint32_t>(ring + p.x);
  if (p.x == n && p.y < n) return static_cast<std::uint32_t>(ring + n + p.y);
  if (p.y == n && p.x > 0) return static_cast<std::uint32_t>(ring + 2 * n + (n - p.x));
  assert(p.x == 0);
  return static_cast<std::uint32_t>(ring + 3 * n + (n - p.y));
}

std::vector<glm::ivec3> QuincunxLattice::places() const {
  std::vector<glm::ivec3> all(size());
  const int n = intervals_;
  for (int z = 0; z <= n; ++z) {
    for (int y = 0; y <= n; ++y) {
      const int step = onFace(z, n) || onFace(y, n) ? 1 : n;
      for (int x = 0; x <= n; x += step) all[pointAt({x, y, z})] = {x, y, z};
    }
  }
  return all;
}

std::uint32_t QuincunxLattice::pointOf(std::uint32_t texel) const {
  const auto size = static_cast<std::uint32_t>(2 * intervals_);
  const CubeFace& face = cubeFace(static_cast<int>(texel / (size * size)));
  const auto column = static_cast<int>((texel % size + 1) / 2),
             row = static_cast<int>((texel / size % size + 1) / 2);
  // axis + a right + b down with a and b from -1 to 1, times N, is twice the place less N.
  const glm::ivec3 twice = intervals_ * glm::ivec3(face.axis) +
                           (2 * column - intervals_) * glm::ivec3(face.right) +
                           (2 * row - intervals_) * glm::ivec3(face.down);
  return pointAt((twice + intervals_) / 2);
}

void QuincunxLattice::addStep(int stride, bool diagonal, std::span<const glm::ivec3> all,
                              std::vector<double>& integrals) {
  std::vector<Odd> step;
  for (std::uint32_t point = 0; point < all.size(); ++point) {
    if (!isOdd(all[point], stride, diagonal)) continue;
    Odd odd{.point = point};
    forNeighbours(all[point], intervals_, stride, diagonal,
                  [&](const glm::ivec3& neighbour) { odd.neighbours[odd.count++] = pointAt(neighbour); });
    step.push_back(odd);
  }
  // The function of a kept point adds those of odd points, weighted as in the prediction. An update in the
  // ratio of the integrals makes the integral of every detail's function 0 [1].
  for (const Odd& odd : step) {
    for (std::uint32_t k = 0; k < odd.count; ++k)
      integrals[odd.neighbours[k]] += integrals[odd.point] / odd.count;
  }
  for (Odd& odd : step) {
    for (std::uint32_t k = 0; k < odd.count; ++k) {
      odd.updates[k] = integrals[odd.point] / (odd.count * integrals[odd.neighbours[k]]);
    }
  }
  steps_.push_back(std::move(step));
}

void QuincunxLattice::forward(std::span<double> values) const {
  assert(values.size() == size());
  for (const std::vector<Odd>& step : steps_) {
    for (const Odd& odd : step) {
      double sum = 0.0;
      for (std::uint32_t k = 0; k < odd.count; ++k) sum += values[odd.neighbours[k]];
      values[odd.point] -= sum / odd.count;
    }
    for (const Odd& odd : step) {
      for (std::uint32_t k = 0; k < odd.count; ++k)
        values[odd.neighbours[k]] += odd.updates[k] * values[odd.point];
    }
  }
}

void QuincunxLattice::inverse(std::span<double> values) const {
  assert(values.size() == size());
  for (std::size_t s = steps_.size(); s-- > 0;) {
    for (const Odd& odd : steps_[s]) {
      for (std::uint32_t k = 0; k < odd.count; ++k)
        values[odd.neighbours[k]] -= odd.updates[k] * values[odd.point];
    }
    for (const Odd& odd : steps_[s]) {
      double sum = 0.0;
      for (std::uint32_t k = 0; k < odd.count; ++k) sum += values[odd.neighbours[k]];
      values[odd.point] += sum / odd.count;
    }
  }
}

void QuincunxLattice::transposedInverse(std::span<double> weights) const {
  assert(weights.size() == size());
  for (const std::vector<Odd>& step : steps_) {  // the transposed steps of inverse(), last step first
    for (const Odd& odd : step) {
      for (std::uint32_t k = 0; k < odd.count; ++k)
        weights[odd.neighbours[k]] += weights[odd.point] / odd.count;
    }
    for (const Odd& odd : step) {
      for (std::uint32_t k = 0; k < odd.count; ++k)
        weights[odd.point] -= odd.updates[k] * weights[odd.neighbours[k]];
    }
  }
}

std::vector<double> QuincunxLattice::functionNorms() const {
  const auto normOf = [&](std::uint32_t coefficient) {
    std::vector<double> values(size(), 0.0);
    values[coefficient] = 1.0;
    inverse(values);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += solidAngles_[i] * values[i] * values[i];
    return std::sqrt(sum);
  };
  const std::vector<glm::ivec3> all = places();
  const glm::dvec3 middle(0.5 * intervals_, 0.5 * intervals_, 0.0);
  std::vector<double> norms(size(),
                            normOf(pointAt({0, 0, 0})));  // norms of the corners, which belong to no step
  for (const std::vector<Odd>& step : steps_) {
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Odd& odd : step) {
      const double distance = glm::distance(glm::dvec3(all[odd.point]), middle);
      if (distance >= least) continue;
      least = distance;
      nearest = odd.point;
    }
    const double norm = normOf(nearest);
    for (const Odd& odd : step) norms[odd.point] = norm;
  }
  return norms;
}

}  // namespace prelight
