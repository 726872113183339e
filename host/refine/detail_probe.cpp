#include "refine/detail_probe.h"

#include <algorithm>
#include <cmath>

#include "basis/sh.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

constexpr std::size_t bands = std::size_t{DetailProbe::order} * DetailProbe::order;

/// Sum of the squares of an open surface's transfer, which does not depend on its normal.
double openSquares() {
  std::array<double, bands> open{};
  sh::openTransfer({0.0, 0.0, 1.0}, DetailProbe::order, open);
  double sum = 0.0;
  for (const double value : open) sum += value * value;
  return sum;
}

/// The least-squares fits of linear functions to two estimates of the same values at points of a plane.
class LinearFits {
 public:
  using Values = std::span<const double, bands>;

  void add(const glm::dvec2& at, Values one, Values other) {
    const glm::dvec3 basis(1.0, at.x, at.y);
    matrix_ += glm::outerProduct(basis, basis);
    for (std::size_t i = 0; i < bands; ++i) {
      sides_[0][i] += one[i] * basis;
      sides_[1][i] += other[i] * basis;
      products_ += one[i] * other[i];
      squares_ += 0.5 * (one[i] * one[i] + other[i] * other[i]);
    }
    ++count_;
  }

  /// Returns what the two fits leave, rms in all values together and without bias by the number of points:
  /// from products of the two, to which independent noise does not contribute, and from squares.
  PartError left() const {
    constexpr int unknowns = 3;
    if (count_ <= unknowns || !(glm::determinant(matrix_) > 1e-12)) return {};
    const glm::dmat3 inverse = glm::inverse(matrix_);
    double products = products_, squares = squares_;
    for (std::size_t i = 0; i < bands; ++i) {
      const glm::dvec3 &one = sides_[0][i], &other = sides_[1][i];
      products -= glm::dot(one, inverse * other);
      squares -= 0.5 * (glm::dot(one, inverse * one) + glm::dot(other, inverse * other));
    }
    const auto rms = [&](double sum) {
      return static_cast<float>(std::sqrt(std::max(0.0, sum) / (count_ - unknowns)));
    };
    return {rms(products), rms(squares)};
  }

 private:
  glm::dmat3 matrix_{0.0};
  std::array<std::array<glm::dvec3, bands>, 2> sides_{};
  double products_ = 0.0, squares_ = 0.0;
  int count_ = 0;
};

/// Computes the transfer of a receiver minus that of an open surface.
void occludedTransfer(const float* row, const float* normal, std::span<double, bands> values) {
  std::array<double, bands> open{};
  sh::openTransfer(glm::dvec3(normal[0], normal[1], normal[2]), DetailProbe::order, open);
  for (std::size_t i = 0; i < bands; ++i)
    values[i] = double(row[HemisphereColumn::firstBand + i]) + (double(row[0]) - 1.0) * open[i];
}

CastOptions probeOptions(std::uint32_t rays) {
  CastOptions options;
  options.raysPerReceiver = rays;
  options.marksInside = true;
  return options;
}

}  // namespace

DetailProbe::DetailProbe(const CompiledScene& scene, Tracer& tracer, std::uint32_t rays,
                         std::span<const double> reaches)
    : scene_(scene),
      column_(order),
      caster_(scene, tracer, probeOptions(rays), std::vector<Column*>{&column_}),
      reaches_{0.0} {
  reaches_.insert(reaches_.end(), reaches.begin(), reaches.end());
}

void DetailProbe::addReceivers(const ProbedPart& part) {
  const std::array<std::uint32_t, 2> seeds = {sampling::hashInteger(2 * part.triangle),
                                              sampling::hashInteger(2 * part.triangle + 1)};
  const double step = 1.0 / part.steps;
  const auto add = [&](double x, double y) {
    const glm::dvec2 weights =
        part.corners[0] + x * (part.corners[1] - part.corners[0]) + y * (part.corners[2] - part.corners[0]);
    const glm::dvec2 kept = keptOffEdges(scene_, part.triangle, weights);
    device::Receiver receiver = receiverAt(
        scene_, {part.triangle, static_cast<float>(kept.x), static_cast<float>(kept.y), 1.0f}, Side::Front);
    for (const std::uint32_t seed : seeds) {
      receiver.seed = seed;
      receivers_.push_back(receiver);
    }
    points_.emplace_back(x, y);
  };
  for (int i = 0; i < part.steps; ++i)
    for (int j = 0; i + j < part.steps; ++j) {
      add((i + 1.0 / 3.0) * step, (j + 1.0 / 3.0) * step);
      if (i + j + 1 < part.steps) add((i + 2.0 / 3.0) * step, (j + 2.0 / 3.0) * step);
    }
}

std::vector<PartError> DetailProbe::residualsOf(double reach, std::span<const std::size_t> ends,
                                                const Progress& progress) {
  std::vector<LinearFits> fits(ends.size());
  CastRows rows;
  std::array<std::array<double, bands>, 2> values{};
  caster_.setFarthest(reach);
  const std::size_t block = caster_.blockSize() / 2 * 2;
  std::size_t part = 0;
  for (std::size_t begin = 0; begin < receivers_.size(); begin += block) {
    progress.check();
    const auto cast = std::span(receivers_).subspan(begin, std::min(block, receivers_.size() - begin));
    caster_.cast(cast, rows);
    rays_ += cast.size() * caster_.raysPerReceiver();
    for (std::size_t r = 0; r < cast.size(); r += 2) {
      while (begin + r >= ends[part]) ++part;
      if (rows.inside[r] != 0 || rows.inside[r + 1] != 0) continue;
      for (std::size_t k = 0; k < 2; ++k)
        occludedTransfer(column_.row(rows, r + k), cast[r + k].normal, values[k]);
      fits[part].add(points_[(begin + r) / 2], values[0], values[1]);
    }
  }
  static const auto scale = static_cast<float>(1.0 / std::sqrt(openSquares()));
  std::vector<PartError> residuals;
  for (const LinearFits& fit : fits) {
    const PartError left = fit.left();
    residuals.push_back({scale * left.error, scale * left.bound});
  }
  return residuals;
}

std::vector<PartError> DetailProbe::errorsOf(std::span<const ProbedPart> parts, Progress& progress,
                                             double from, double to) {
  const std::size_t block = caster_.blockSize();
  std::vector<PartError> errors(parts.size());
  std::vector<std::size_t> ends;
  for (std::size_t first = 0; first < parts.size(); first += ends.size()) {
    receivers_.clear();
    points_.clear();
    ends.clear();
    for (std::size_t i = first; i < parts.size() && receivers_.size() < block; ++i) {
      addReceivers(parts[i]);
      ends.push_back(receivers_.size());
    }
    for (const double reach : reaches_) {
      const std::vector<PartError> residuals = residualsOf(reach, ends, progress);
      for (std::size_t i = 0; i < residuals.size(); ++i) {
        PartError& most = errors[first + i];
        most = {std::max(most.error, residuals[i].error), std::max(most.bound, residuals[i].bound)};
      }
    }
    progress.report("refine", from + (to - from) * double(first + ends.size()) / double(parts.size()));
  }
  return errors;
}

}  // namespace prelight
