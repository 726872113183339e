#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "receivers/fit_mesh.h"

namespace prelight {

/// Sum of the weights of a triangle's samples, from their sums of products of barycentric weights (00 11 22
/// 01 12 20), which sum to 1.
double totalWeight(const std::array<double, 6>& mass);

/// An unknown of the normal equations with a factor.
struct SlotWeight {
  std::uint32_t slot = 0;
  double weight = 0.0;
};

/// The normal equations of a vertex fit as a sparse matrix A over the mesh's edges.
class NormalEquations {
 public:
  /// `mass` of the samples in every triangle; `lambda` is the strength of the smoothing, times `stiffness`,
  /// [slot], > 0; empty: 1.
  NormalEquations(const FitMesh& mesh, const std::vector<std::array<double, 6>>& mass, double lambda,
                  const std::vector<double>& stiffness = {});

  std::size_t rows() const { return diagonal_.size(); }

  /// What a row's right-hand side is to be multiplied by: every stretch of surface has a scale of its own.
  double factor(std::size_t row) const { return factors_[row]; }

  /// Diagonal of the whole operator, for preconditioning; positive.
  double preconditioner(std::size_t row) const { return total_[row]; }

  /// y = (A + lambda L^T S L + floor) x, [slot][column]. `scratch` has the size of x.
  void apply(const std::vector<double>& x, std::vector<double>& y, std::vector<double>& scratch,
             std::size_t columns) const;

  /// y = L x: a slot's value less the mean of its neighbours', weighted by the surface that they share; 0 for
  /// a slot without neighbours. [slot][column]
  void laplacian(const std::vector<double>& x, std::vector<double>& y, std::size_t columns) const;

  /// A slot's value as a weighted sum of right-hand sides around it: the row of the inverse, with all
  /// unknowns more than two edges away held at 0, corrected so that linear functions of the place stay exact.
  /// Empty where no sample is near. In ascending order of slots.
  std::vector<SlotWeight> inverseRow(std::uint32_t slot) const;

 private:
  void addEdge(std::uint32_t a, std::uint32_t b, double value, double weight);
  std::size_t find(std::uint32_t row, std::uint32_t column) const;
  void evenOutComponents();
  void scaleRegularizer();
  glm::dvec4 rightSideOfLinear(std::size_t slot) const;
  std::vector<std::uint32_t> around(std::uint32_t slot) const;
  std::vector<double> denseBlock(const std::vector<std::uint32_t>& slots) const;

  const FitMesh& mesh_;
  std::vector<double> diagonal_;
  std::vector<double> offDiagonal_;  ///< parallel to mesh_.columns
  std::vector<double> edgeWeight_;   ///< parallel to mesh_.columns, symmetric
  std::vector<double> edgeSum_;      ///< [slot], of its edges' weights
  std::vector<double> share_;        ///< [edge], the Laplacian's entries
  std::vector<double> transposed_;   ///< [edge], -lambda x entries of its scaled transpose
  std::vector<double> scale_;
  std::vector<double> total_;
  double lambda_;
  std::vector<double> factors_;  ///< [slot], that the equations of its component are multiplied by
};

}  // namespace prelight
