#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "receivers/fit_mesh.h"

namespace prelight {

/// Sums over a triangle's samples of their weight times products of barycentric weights: 00 11 22 01 12 20.
using TriangleMass = std::array<float, 6>;

/// Sum of the weights of a triangle's samples: barycentric weights sum to 1.
double totalWeight(const TriangleMass& mass);

/// An unknown of the normal equations with a factor.
struct SlotWeight {
  std::uint32_t slot = 0;
  double weight = 0.0;
};

/// The normal equations of a vertex fit, (A + lambda L^T S L + floor) x = b, as a sparse matrix over the
/// mesh's edges. Rows are the sampled slots, those of a triangle with a sample, in ascending order; what lies
/// farther from any sample is not determined by them (see extendFit()). Entries are in single precision.
class NormalEquations {
 public:
  static constexpr std::uint32_t noRow = ~0u;

  /// `mass` of the samples in every triangle; `lambda` is the strength of the smoothing, times `stiffness`,
  /// [slot], > 0; empty: 1. `unseen`, [triangle], is the weight of samples that the mass leaves out: surface
  /// that is smoothed like any other and has no say. Empty: 0.
  NormalEquations(const FitMesh& mesh, std::span<const TriangleMass> mass, double lambda,
                  std::span<const double> stiffness = {}, std::span<const float> unseen = {});

  std::size_t rows() const { return slots_.size(); }

  /// [row], ascending.
  const std::vector<std::uint32_t>& slots() const { return slots_; }

  /// noRow for a slot that is not sampled.
  std::uint32_t rowOf(std::uint32_t slot) const { return rowOfSlot_[slot]; }

  /// What a row's right-hand side is to be multiplied by: every stretch of surface has a scale of its own.
  double factor(std::size_t row) const { return factors_[row]; }

  /// Of the operator's diagonal, for preconditioning; positive.
  float inverseDiagonal(std::size_t row) const { return entries_[row].inverseDiagonal; }

  /// The operator in two sweeps over the rows of x, [row][W]. The first gives `bend`, the second the image.
  template <std::size_t W>
  void bend(std::size_t row, const float* x, float* bend) const;
  template <std::size_t W>
  void applyRow(std::size_t row, const float* x, const float* bend, float* image) const;

  /// L x: a slot's value less the mean of its neighbours', weighted by the surface that they share; 0 for a
  /// slot without. x and the result are [slot].
  std::vector<double> laplacian(std::span<const float> x) const;

  /// A slot's value as a weighted sum of right-hand sides around it: the row of the inverse, with all
  /// unknowns more than two edges away held at 0, corrected so that linear functions of the place stay exact.
  /// Of a slot that is not sampled, the mean of its neighbours' rows. Empty where no sample is near. In
  /// ascending order of slots.
  std::vector<SlotWeight> inverseRow(std::uint32_t slot) const;

 private:
  struct Entry {
    float diagonal = 0.0f;  ///< of A + floor
    float edgeSum = 0.0f;   ///< of the edges' weights
    float pull = 0.0f;      ///< lambda S / edgeSum^2, 0 without edges
    float inverseDiagonal = 0.0f;
  };
  struct Edge {
    std::uint32_t row = 0;
    float value = 0.0f;   ///< of A
    float weight = 0.0f;  ///< of the Laplacian, symmetric
  };

  static constexpr std::size_t rowSides = 5;  ///< right-hand sides that a row of the inverse takes

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

// With t = edgeSum x - sum w x_j, L x is t / edgeSum; bend is lambda S L x / edgeSum.
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
