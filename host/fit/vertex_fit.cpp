#include "fit/vertex_fit.h"

#include <cmath>

#include "fit/extend_fit.h"

namespace prelight {

namespace {

/// Samples of one triangle that follow one another.
struct Run {
  std::uint32_t triangle = 0;
  std::uint32_t count = 0;
  std::array<double, 6> mass{};
  std::vector<double> right;  ///< [corner][column]
};

/// Calls use(run) for every run of the samples, whose values are [sample][column].
template <typename Value, typename Use>
void forRuns(std::span<const SurfaceSample> samples, std::span<const Value> values, std::size_t columns,
             const Use& use) {
  Run run;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i].triangle != run.triangle) {
      if (run.count > 0) use(run);
      run.triangle = samples[i].triangle;
      run.count = 0;
      run.mass = {};
      run.right.assign(3 * columns, 0.0);
    }
    ++run.count;
    const std::array<double, 3> b = cornerWeights(samples[i]);
    const double weight = samples[i].weight;
    const Value* row = values.data() + i * columns;
    for (std::size_t k = 0; k < 3; ++k) {
      run.mass[k] += weight * b[k] * b[k];
      run.mass[3 + k] += weight * b[k] * b[(k + 1) % 3];
      double* right = &run.right[k * columns];
      for (std::size_t c = 0; c < columns; ++c) right[c] += weight * b[k] * row[c];
    }
  }
  if (run.count > 0) use(run);
}

}  // namespace

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns)
    : mesh_(&mesh),
      columns_(columns),
      counts_(mesh.triangles.size()),
      mass_(mesh.triangles.size()),
      right_(mesh.slotCount() * columns, 0.0f) {}

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights)
    : mesh_(&mesh),
      columns_(columns),
      triangleWeights_(std::move(triangleWeights)),
      counts_(mesh.triangles.size()),
      mass_(mesh.triangles.size()),
      right_(3 * mesh.triangles.size() * columns, 0.0f) {}

std::size_t VertexFit::rowOf(std::size_t triangle, std::size_t corner) const {
  return triangleWeights_.empty() ? mesh_->triangles[triangle][corner] : 3 * triangle + corner;
}

void VertexFit::add(std::span<const SurfaceSample> samples, std::span<const double> values) {
  accumulate(samples, values, 1);
}

void VertexFit::remove(std::span<const SurfaceSample> samples, std::span<const double> values) {
  accumulate(samples, values, -1);
}

// A triangle without samples has no mass, not what rounding leaves of it.
void VertexFit::accumulate(std::span<const SurfaceSample> samples, std::span<const double> values, int sign) {
  const auto signedSum = [&](double sum) { return static_cast<float>(sign * sum); };
  forRuns(samples, values, columns_, [&](const Run& run) {
    counts_[run.triangle] += sign > 0 ? run.count : 0u - run.count;
    for (std::size_t k = 0; k < 6; ++k) mass_[run.triangle][k] += signedSum(run.mass[k]);
    if (counts_[run.triangle] == 0) mass_[run.triangle] = {};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < columns_; ++c)
        right_[rowOf(run.triangle, k) * columns_ + c] += signedSum(run.right[k * columns_ + c]);
  });
}

void VertexFit::addTo(std::span<float> rightSide, std::span<const SurfaceSample> samples,
                      std::span<const float> values) const {
  const std::size_t columns = values.size() / samples.size();
  forRuns(samples, values, columns, [&](const Run& run) {
    const double scale = scaleOf(run.triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      float* right = &rightSide[mesh_->triangles[run.triangle][k] * columns];
      for (std::size_t c = 0; c < columns; ++c)
        right[c] += static_cast<float>(scale * run.right[k * columns + c]);
    }
  });
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
  for (const TriangleMass& mass : mass_) state.requireFinite(mass);
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
std::vector<float> VertexFit::rightSide(std::size_t firstColumn, std::size_t count) const {
  std::vector<float> right(mesh_->slotCount() * count, 0.0f);
  const auto addRow = [&](std::size_t slot, double scale, std::size_t row) {
    for (std::size_t c = 0; c < count; ++c)
      right[slot * count + c] += static_cast<float>(scale * right_[row * columns_ + firstColumn + c]);
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

std::vector<float> VertexFit::solve(double lambda, std::span<const float> rightSide, std::size_t columns,
                                    const SolveLimits& limits) const {
  return solve(equations(lambda), rightSide, columns, limits);
}

std::vector<float> VertexFit::solve(const NormalEquations& equations, std::span<const float> rightSide,
                                    std::size_t columns, const SolveLimits& limits) const {
  return solveFrom(equations, rightSide, columns, std::vector<float>(rightSide.size(), 0.0f), limits);
}

std::vector<float> VertexFit::solveFrom(double lambda, std::vector<float> guess,
                                        const SolveLimits& limits) const {
  return triangleWeights_.empty()
             ? solveFrom(equations(lambda), right_, 1, std::move(guess), limits)
             : solveFrom(equations(lambda), rightSide(0, 1), 1, std::move(guess), limits);
}

std::vector<float> VertexFit::solveFrom(const NormalEquations& equations, std::span<const float> rightSide,
                                        std::size_t columns, std::vector<float> guess,
                                        const SolveLimits& limits) const {
  conjugateGradients(equations, rightSide, columns, guess, limits);
  extendFit(*mesh_, equations, extent_, columns, guess);
  return guess;
}

NormalEquations VertexFit::equations(double lambda) const {
  if (triangleWeights_.empty()) return {*mesh_, mass_, lambda, stiffness_};
  std::vector<TriangleMass> mass = mass_;
  for (std::size_t t = 0; t < mass.size(); ++t) {
    const double scale = scaleOf(t);
    for (float& m : mass[t]) m = static_cast<float>(scale * m);
  }
  return {*mesh_, mass, lambda, stiffness_};
}

}  // namespace prelight
