#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/state_file.h"
#include "fit/conjugate_gradients.h"
#include "fit/normal_equations.h"
#include "receivers/fit_mesh.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Weighted least squares of per-vertex values to samples inside the triangles: minimises
///   sum_s w_s |sum_i b_i(s) x_i - f_s|^2 + lambda |L x|^2,
/// L the graph Laplacian scaled by each slot's weight. What is fitted is what a rasteriser will interpolate
/// (Kavan et al. 2011, "Least Squares Vertex Baking").
class VertexFit {
 public:
  /// `columns` values a sample.
  VertexFit(const FitMesh& mesh, std::size_t columns);

  /// A fit for samples that crowd where they are needed: the samples of a triangle together weigh its entry
  /// of `triangleWeights`, however many there are, so that what is minimised stays the error over the
  /// surface. Keeps its sums a triangle corner, six times as much memory.
  VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights);

  /// Adds samples with their values, [sample][column]. Those of one triangle that follow one another are
  /// summed up in double precision before they join the sums of all, which are in single.
  void add(std::span<const SurfaceSample> samples, std::span<const double> values);
  void add(const SurfaceSample& sample, std::span<const double> values) {
    add(std::span(&sample, 1), values);
  }

  /// Takes away what add() has added.
  void remove(std::span<const SurfaceSample> samples, std::span<const double> values);

  std::size_t columns() const { return columns_; }

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// What a sample weighs in the fit.
  double weightOf(const SurfaceSample& sample) const { return sample.weight * scaleOf(sample.triangle); }

  /// [slot][column]. Slots without a sample near take their neighbours' values, or 0 when they have none.
  std::vector<float> solve(double lambda) const;

  /// [slot], of one column alone.
  std::vector<float> solveColumn(double lambda, std::size_t column) const;

  /// The same of a fit of one column from a guess that is near, [slot].
  std::vector<float> solveFrom(double lambda, std::vector<float> guess, const SolveLimits& limits) const;

  /// Adds what samples of this fit have in other columns, [sample][column], to a right-hand side for solve(),
  /// [slot][column].
  void addTo(std::span<float> rightSide, std::span<const SurfaceSample> samples,
             std::span<const float> values) const;

  /// Solves for another right-hand side [slot][column] with this fit's samples.
  std::vector<float> solve(double lambda, std::span<const float> rightSide, std::size_t columns,
                           const SolveLimits& limits = {}) const;

  /// The equations that solve() solves, for those who want rows of their inverse or solve them more than
  /// once.
  NormalEquations equations(double lambda) const;

  /// Solves equations() for a right-hand side, [slot][column].
  std::vector<float> solve(const NormalEquations& equations, std::span<const float> rightSide,
                           std::size_t columns, const SolveLimits& limits = {}) const;

  /// Smooths each slot as many times as strongly from now on, [slot], > 0 (see stiffnessOf()).
  void stiffen(std::vector<double> stiffness) { stiffness_ = std::move(stiffness); }
  const std::vector<double>& stiffness() const { return stiffness_; }

  /// Of the slots without a sample near, only those of `extent`, [slot], get values; empty: all.
  void extendTo(std::vector<std::uint8_t> extent) { extent_ = std::move(extent); }
  const std::vector<std::uint8_t>& extent() const { return extent_; }

 private:
  void accumulate(std::span<const SurfaceSample> samples, std::span<const double> values, int sign);
  std::size_t rowOf(std::size_t triangle, std::size_t corner) const;
  double scaleOf(std::size_t triangle) const;
  std::vector<float> rightSide(std::size_t firstColumn, std::size_t count) const;
  std::vector<float> solveFrom(const NormalEquations& equations, std::span<const float> rightSide,
                               std::size_t columns, std::vector<float> guess,
                               const SolveLimits& limits) const;

  const FitMesh* mesh_;  ///< not null
  std::size_t columns_;
  std::vector<double> stiffness_;        ///< [slot], or empty: 1
  std::vector<std::uint8_t> extent_;     ///< [slot], or empty: all
  std::vector<double> triangleWeights_;  ///< [triangle], or empty: samples weigh what they say
  std::vector<std::uint32_t> counts_;    ///< [triangle], samples
  std::vector<TriangleMass> mass_;       ///< [triangle]
  std::vector<float> right_;             ///< [slot][column], or [triangle][corner][column]: sum w b f
};

/// The strength that served best over the built-in scenes, see docs/accuracy.md.
constexpr double defaultSmoothing = 0.03;

}  // namespace prelight
