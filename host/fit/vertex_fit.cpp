#include "fit/vertex_fit.h"

#include <cmath>

#include "fit/extend_fit.h"

namespace prelight {

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns)
    : mesh_(&mesh),
      columns_(columns),
      counts_(mesh.triangles.size()),
      mass_(mesh.triangles.size()),
      right_(mesh.slotCount() * columns, 0.0) {}

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights)
    : mesh_(&mesh),
      columns_(columns),
      triangleWeights_(std::move(triangleWeights)),
      counts_(mesh.triangles.size()),
      mass_(mesh.triangles.size()),
      right_(3 * mesh.triangles.size() * columns, 0.0) {}

void VertexFit::add(const SurfaceSample& sample, std::span<const double> values) {
  add(sample, sample.weight, values);
  ++counts_[sample.triangle];
}

// A triangle without samples has no mass, not what rounding leaves of it.
void VertexFit::remove(const SurfaceSample& sample, std::span<const double> values) {
  add(sample, -sample.weight, values);
  if (--counts_[sample.triangle] == 0) mass_[sample.triangle] = {};
}

void VertexFit::add(const SurfaceSample& sample, double weight, std::span<const double> values) {
  const std::array<double, 3> b = cornerWeights(sample);
  auto& mass = mass_[sample.triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    mass[k] += weight * b[k] * b[k];
    mass[3 + k] += weight * b[k] * b[(k + 1) % 3];
    const std::size_t row =
        triangleWeights_.empty() ? mesh_->triangles[sample.triangle][k] : 3 * std::size_t{sample.triangle} + k;
    double* right = &right_[row * columns_];
    const double share = weight * b[k];
    for (std::size_t c = 0; c < columns_; ++c) right[c] += share * values[c];
  }
}

void VertexFit::addTo(std::span<double> rightSide, const SurfaceSample& sample,
                      std::span<const float> values) const {
  const std::array<double, 3> b = cornerWeights(sample);
  for (std::size_t k = 0; k < 3; ++k) {
    double* right = &rightSide[mesh_->triangles[sample.triangle][k] * values.size()];
    const double share = weightOf(sample) * b[k];
    for (std::size_t c = 0; c < values.size(); ++c) right[c] += share * values[c];
  }
}

void VertexFit::save(StateWriter& state) const {
  state.values(counts_);
  state.values(mass_);
  state.values(right_);
  state.values(stiffness_);
}

void VertexFit::load(StateReader& state) {
  state.sameSize(counts_);
  state.sameSize(mass_);
  state.sameSize(right_);
  state.values(stiffness_);
  state.require(stiffness_.empty() || stiffness_.size() == mesh_->slotCount());
  for (const std::array<double, 6>& mass : mass_) state.requireFinite(mass);
  state.requireFinite(right_);
  state.requireFinite(stiffness_);
  for (const double stiffness : stiffness_) state.require(stiffness > 0.0);
}

double VertexFit::scaleOf(std::size_t triangle) const {
  if (triangleWeights_.empty()) return 1.0;
  const double weight = totalWeight(mass_[triangle]);
  return weight > 0.0 ? triangleWeights_[triangle] / weight : 0.0;
}

/// Columns [firstColumn, firstColumn + count) of the equations' right side, [slot][count].
std::vector<double> VertexFit::rightSide(std::size_t firstColumn, std::size_t count) const {
  std::vector<double> right(mesh_->slotCount() * count, 0.0);
  const auto addRow = [&](std::size_t slot, double scale, std::size_t row) {
    for (std::size_t c = 0; c < count; ++c)
      right[slot * count + c] += scale * right_[row * columns_ + firstColumn + c];
  };
  if (triangleWeights_.empty())
    for (std::size_t slot = 0; slot < mesh_->slotCount(); ++slot) addRow(slot, 1.0, slot);
  else
    for (std::size_t t = 0; t < mass_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) addRow(mesh_->triangles[t][k], scaleOf(t), 3 * t + k);
  return right;
}

std::vector<float> VertexFit::solve(double lambda) const {
  return triangleWeights_.empty() ? solve(lambda, right_, columns_)
                                  : solve(lambda, rightSide(0, columns_), columns_);
}

std::vector<float> VertexFit::solveColumn(double lambda, std::size_t column) const {
  return solve(lambda, rightSide(column, 1), 1);
}

std::vector<float> VertexFit::solve(double lambda, std::span<const double> rightSide, std::size_t columns,
                                    const SolveLimits& limits) const {
  return solve(equations(lambda), rightSide, columns, std::vector<float>(rightSide.size(), 0.0f), limits);
}

std::vector<float> VertexFit::solveFrom(double lambda, std::vector<float> guess,
                                        const SolveLimits& limits) const {
  return triangleWeights_.empty()
             ? solve(equations(lambda), right_, 1, std::move(guess), limits)
             : solve(equations(lambda), rightSide(0, 1), 1, std::move(guess), limits);
}

std::vector<float> VertexFit::solve(const NormalEquations& equations, std::span<const double> rightSide,
                                    std::size_t columns, std::vector<float> guess,
                                    const SolveLimits& limits) const {
  conjugateGradients(equations, rightSide, columns, guess, limits);
  extendFit(*mesh_, equations, extent_, columns, guess);
  return guess;
}

NormalEquations VertexFit::equations(double lambda) const {
  if (triangleWeights_.empty()) return {*mesh_, mass_, lambda, stiffness_};
  std::vector<std::array<double, 6>> mass = mass_;
  for (std::size_t t = 0; t < mass.size(); ++t) {
    const double scale = scaleOf(t);
    for (double& m : mass[t]) m *= scale;
  }
  return {*mesh_, mass, lambda, stiffness_};
}

}  // namespace prelight
