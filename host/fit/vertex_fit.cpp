#include "fit/vertex_fit.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "fit/normal_equations.h"

namespace prelight {

namespace {

constexpr std::size_t rowGrain = 1024;
constexpr int maxIterations = 64;   // 10 to 25 do, but for stretches without samples, which nothing sees
constexpr double tolerance = 1e-6;  // of the residual's norm, below float and far below noise

/// Sum over slots of a[slot][c] b[slot][c] for every column, in an order that no thread count changes.
std::vector<double> columnDots(const std::vector<double>& a, const std::vector<double>& b,
                               std::size_t columns) {
  const std::size_t rows = a.size() / columns;
  const std::size_t ranges = (rows + rowGrain - 1) / rowGrain;
  std::vector<double> partial(ranges * columns, 0.0);
  parallelRanges(rows, rowGrain, [&](std::size_t begin, std::size_t end) {
    double* out = &partial[begin / rowGrain * columns];
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t c = 0; c < columns; ++c) out[c] += a[i * columns + c] * b[i * columns + c];
  });
  std::vector<double> sums(columns, 0.0);
  for (std::size_t r = 0; r < ranges; ++r)
    for (std::size_t c = 0; c < columns; ++c) sums[c] += partial[r * columns + c];
  return sums;
}

/// Preconditioned conjugate gradients with Jacobi's preconditioner, each column on its own step sizes.
std::vector<double> conjugateGradients(const NormalEquations& equations, const std::vector<double>& right,
                                       std::size_t columns) {
  std::vector<double> x(right.size(), 0.0), residual(right.size()), direction(right.size()),
      image(right.size()), z(right.size()), scratch(right.size());
  for (std::size_t i = 0; i < right.size(); ++i) residual[i] = equations.factor(i / columns) * right[i];
  const auto precondition = [&] {
    parallelRanges(equations.rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < columns; ++c)
          z[i * columns + c] = residual[i * columns + c] / equations.preconditioner(i);
    });
  };
  precondition();
  direction = z;
  std::vector<double> rho = columnDots(residual, z, columns);
  const std::vector<double> start = rho;
  for (int iteration = 0; iteration < maxIterations; ++iteration) {
    bool done = true;
    for (std::size_t c = 0; c < columns; ++c) done = done && rho[c] <= tolerance * tolerance * start[c];
    if (done) break;
    equations.apply(direction, image, scratch, columns);
    const std::vector<double> curvature = columnDots(direction, image, columns);
    std::vector<double> step(columns);
    for (std::size_t c = 0; c < columns; ++c) step[c] = curvature[c] > 0.0 ? rho[c] / curvature[c] : 0.0;
    parallelRanges(equations.rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < columns; ++c) {
          x[i * columns + c] += step[c] * direction[i * columns + c];
          residual[i * columns + c] -= step[c] * image[i * columns + c];
        }
    });
    precondition();
    const std::vector<double> next = columnDots(residual, z, columns);
    parallelRanges(equations.rows(), rowGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t c = 0; c < columns; ++c) {
          const double beta = rho[c] > 0.0 ? next[c] / rho[c] : 0.0;
          direction[i * columns + c] = z[i * columns + c] + beta * direction[i * columns + c];
        }
    });
    rho = next;
  }
  return x;
}

}  // namespace

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns)
    : mesh_(mesh), columns_(columns), mass_(mesh.triangles.size()), right_(mesh.slotCount() * columns, 0.0) {}

VertexFit::VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights)
    : mesh_(mesh),
      columns_(columns),
      triangleWeights_(std::move(triangleWeights)),
      mass_(mesh.triangles.size()),
      right_(3 * mesh.triangles.size() * columns, 0.0) {}

void VertexFit::add(const SurfaceSample& sample, std::span<const double> values) {
  const std::array<double, 3> b = cornerWeights(sample);
  auto& mass = mass_[sample.triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    mass[k] += sample.weight * b[k] * b[k];
    mass[3 + k] += sample.weight * b[k] * b[(k + 1) % 3];
    const std::size_t row =
        triangleWeights_.empty() ? mesh_.triangles[sample.triangle][k] : 3 * std::size_t{sample.triangle} + k;
    double* right = &right_[row * columns_];
    for (std::size_t c = 0; c < columns_; ++c) right[c] += sample.weight * b[k] * values[c];
  }
}

void VertexFit::save(StateWriter& state) const {
  state.values(mass_);
  state.values(right_);
  state.values(stiffness_);
}

void VertexFit::load(StateReader& state) {
  state.sameSize(mass_);
  state.sameSize(right_);
  state.values(stiffness_);
  state.require(stiffness_.empty() || stiffness_.size() == mesh_.slotCount());
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
  std::vector<double> right(mesh_.slotCount() * count, 0.0);
  const auto addRow = [&](std::size_t slot, double scale, std::size_t row) {
    for (std::size_t c = 0; c < count; ++c)
      right[slot * count + c] += scale * right_[row * columns_ + firstColumn + c];
  };
  if (triangleWeights_.empty())
    for (std::size_t slot = 0; slot < mesh_.slotCount(); ++slot) addRow(slot, 1.0, slot);
  else
    for (std::size_t t = 0; t < mass_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) addRow(mesh_.triangles[t][k], scaleOf(t), 3 * t + k);
  return right;
}

std::vector<double> VertexFit::solve(double lambda) const {
  return solve(lambda, rightSide(0, columns_), columns_);
}

std::vector<double> VertexFit::solveColumn(double lambda, std::size_t column) const {
  return solve(lambda, rightSide(column, 1), 1);
}

std::vector<double> VertexFit::solve(double lambda, const std::vector<double>& rightSide,
                                     std::size_t columns) const {
  return conjugateGradients(equations(lambda), rightSide, columns);
}

std::vector<std::array<double, 6>> VertexFit::scaledMass() const {
  std::vector<std::array<double, 6>> mass = mass_;
  for (std::size_t t = 0; t < mass.size(); ++t) {
    const double scale = scaleOf(t);
    for (double& m : mass[t]) m *= scale;
  }
  return mass;
}

}  // namespace prelight
