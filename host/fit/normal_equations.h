#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "receivers/fit_mesh.h"

namespace prelight {

/// Sums over a triangle's samples of weight x product of two barycentric weights: 00 11 22 01 12 20.
using TriangleMass = std::array<float, 6>;

/// Returns the sum of the weights of a triangle's samples, as barycentric weights sum to 1.
double totalWeight(const TriangleMass& mass);

/// A slot (an unknown of the normal equations, see FitMesh) with a factor.
struct SlotWeight {
  std::uint32_t slot = 0;
  double weight = 0.0;
};

/// The normal equations of a vertex fit, (A + lambda L^T S L + floor) x = b, as a sparse matrix over the
/// mesh's edges. The rows are the sampled slots, which are those of triangles with a sample, in ascending
/// order. The equations do not determine other slots (see extendFit()). Entries are in single precision.
class NormalEquations {
 public:
  static constexpr std::uint32_t noRow = ~0u;

  /// `mass` is that of the samples in every triangle. `lambda` times `stiffness`, [slot], > 0, is the
  /// strength of the smoothing; empty: 1. `unseen`, [triangle], is the weight of samples that are left out of
  /// the mass: their surface is smoothed like any other but does not influence values. Empty: 0.
  NormalEquations(const FitMesh& mesh, std::span<const TriangleMass> mass, double lambda,
                  std::span<const double> stiffness = {}, std::span<const float> unseen = {});

  std::size_t rows() const { return slots_.size(); }

  /// Returns the slots of the rows, [row], ascending.
  const std::vector<std::uint32_t>& slots() const { return slots_; }

  /// Returns the row of a slot, or noRow if it is not sampled.
  std::uint32_t rowOf(std::uint32_t slot) const { return rowOfSlot_[slot]; }

  /// Returns the factor to multiply a row's right-hand side by: each connected component of the surface has a
  /// scale of its own.
  double factor(std::size_t row) const { return factors_[row]; }

  /// Returns the inverse of the operator's diagonal, > 0, for preconditioning.
  float inverseDiagonal(std::size_t row) const { return entries_[row].inverseDiagonal; }

  /// Apply the operator in two sweeps over the rows of x, [row][W]. The first yields `bend`, the second the
  /// image.
  template <std::size_t W>
  void bend(std::size_t row, const float* x, float* bend) const;
  template <std::size_t W>
  void applyRow(std::size_t row, const float* x, const float* bend, float* image) const;

  /// Returns L x, [slot]: a slot's value minus the mean of its neighbours' values, weighted by the area that
  /// they share; 0 for a slot without neighbours. x is [slot].
  std::vector<double> laplacian(std::span<const float> x) const;

  /// Returns a slot's value as a weighted sum of the right-hand sides around it, in ascending order of slots:
  /// the row of the inverse with all unknowns more than two edges away fixed at 0, corrected so that linear
  /// functions of position are reproduced. For a slot that is not sampled: the mean of its neighbours' rows,
  /// or empty if none is sampled.
  std::vector<SlotWeight> inverseRow(std::uint32_t slot) const;

 private:
  struct Entry {
    float diagonal = 0.0f;  ///< diagonal entry of A + floor
    float edgeSum = 0.0f;   ///< sum of the edges' weights
    float pull = 0.0f;      ///< lambda S / edgeSum^2, 0 without edges
    float inverseDiagonal = 0.0f;
  };
  struct Edge {
    std::uint32_t row = 0;
    float value = 0.0f;   ///< entry of A
    float weight = 0.0f;  ///< weight in the Laplacian, symmetric
  };

  static constexpr std::size_t rowSides = 5;  ///< right-hand sides for one row of the inverse

  struct EdgeSums {
    double value = 0.0, weight = 0.0;
  };

  void numberRows(const std::vector<double>& scale);
  void evenOutComponents(const std::vector<double>& scale);
  void assemble(std::span<const TriangleMass> mass, std::span<const float> unseen);
  void assembleRow(std::span<const TriangleMass> mass, std::span<const float> unseen, std::size_t row,
                   std::vector<EdgeSums>& sums);
  void smooth(double lambda, const std::vector<double>& scale, std::span<const double> stiffness);
  std::vector<SlotWeight> sampledRow(std::uint32_t row) const;
  std::vector<SlotWeight> meanOfNeighbours(std::uint32_t slot) const;
  glm::dvec4 rightSideOfLinear(std::uint32_t row) const;
  std::vector<double> rightSidesOfRow(const std::vector<std::uint32_t>& rows, std::uint32_t row) const;
  std::vector<std::uint32_t> around(std::uint32_t row) const;
  std::vector<double> denseBlock(const std::vector<std::uint32_t>& rows) const;

  const FitMesh& mesh_;
  std::vector<std::uint32_t> slots_;
  std::vector<std::uint32_t> rowOfSlot_;
  std::vector<std::uint32_t> start_;  ///< [row + 1], into edges
  std::vector<Edge> edges_;
  std::vector<Entry> entries_;  ///< [row]
  std::vector<double> factors_;
};

// With t = edgeSum x - sum w x_j, L x is t / edgeSum, and bend is lambda S L x / edgeSum.
template <std::size_t W>
void NormalEquations::bend(std::size_t row, const float* x, float* bend) const {
  const Entry& entry = entries_[row];
  std::array<float, W> t;
  for (std::size_t c = 0; c < W; ++c) t[c] = entry.edgeSum * x[row * W + c];
  for (std::uint32_t e = start_[row]; e < start_[row + 1]; ++e) {
    const Edge edge = edges_[e];
    const float* of = x + std::size_t{edge.row} * W;
    for (std::size_t c = 0; c < W; ++c) t[c] -= edge.weight * of[c];
  }
  for (std::size_t c = 0; c < W; ++c) bend[row * W + c] = entry.pull * t[c];
}

template <std::size_t W>
void NormalEquations::applyRow(std::size_t row, const float* x, const float* bend, float* image) const {
  const Entry& entry = entries_[row];
  std::array<float, W> sum;
  for (std::size_t c = 0; c < W; ++c)
    sum[c] = entry.diagonal * x[row * W + c] + entry.edgeSum * bend[row * W + c];
  for (std::uint32_t e = start_[row]; e < start_[row + 1]; ++e) {
    const Edge edge = edges_[e];
    const std::size_t other = std::size_t{edge.row} * W;
    for (std::size_t c = 0; c < W; ++c) sum[c] += edge.value * x[other + c] - edge.weight * bend[other + c];
  }
  for (std::size_t c = 0; c < W; ++c) image[row * W + c] = sum[c];
}

}  // namespace prelight
