#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/spill_file.h"
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

  std::size_t columns() const { return columns_; }

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Moves the sums to a file, from where what solves reads them for as long as it takes, until fetch()
  /// brings them back for further samples. Fits with triangle weights stay: those are read sample by sample.
  void park();
  void fetch();

  /// What a sample weighs in the fit.
  double weightOf(const SurfaceSample& sample) const { return sample.weight * scaleOf(sample.triangle); }

  /// [slot][column]. Slots without a sample near take their neighbours' values, or 0 when they have none.
  std::vector<float> solve(double lambda, const SolveLimits& limits = {}) const;

  /// [slot], of one column alone.
  std::vector<float> solveColumn(double lambda, std::size_t column, const SolveLimits& limits = {}) const;

  /// Adds what samples of this fit have in other columns, [sample][column], to a right-hand side for solve(),
  /// [slot][column].
  void addTo(std::span<float> rightSide, std::span<const SurfaceSample> samples,
             std::span<const float> values) const;

  /// The equations that solve() solves, for those who want rows of their inverse or solve them more than
  /// once.
  NormalEquations equations(double lambda) const;

  /// Solves equations() for this fit's columns, [slot][column]; for one of them, [slot]; for another
  /// right-hand side, [slot][column], in whose memory the solution comes.
  std::vector<float> solve(const NormalEquations& equations, const SolveLimits& limits = {}) const;
  std::vector<float> solveColumn(const NormalEquations& equations, std::size_t column,
                                 const SolveLimits& limits = {}) const;
  std::vector<float> solve(const NormalEquations& equations, std::vector<float> rightSide,
                           std::size_t columns, const SolveLimits& limits = {}) const;

  /// Smooths each slot as many times as strongly from now on, [slot], > 0 (see stiffnessOf()).
  void stiffen(std::vector<double> stiffness) { stiffness_ = std::move(stiffness); }
  const std::vector<double>& stiffness() const { return stiffness_; }

  /// Weight of samples that were added with less, [triangle]: their surface is smoothed like any other. It
  /// may grow afterwards; nullptr: none.
  void leaveOut(std::shared_ptr<const std::vector<float>> unseen) { unseen_ = std::move(unseen); }

  /// Of the slots without a sample near, only those of `extent`, [slot], get values; empty: all.
  void extendTo(std::vector<std::uint8_t> extent) { extent_ = std::move(extent); }
  const std::vector<std::uint8_t>& extent() const { return extent_; }

 private:
  std::size_t massBytes() const { return mesh_->triangles.size() * sizeof(TriangleMass); }
  std::vector<TriangleMass> parkedMass() const;
  std::vector<float> parkedRight() const;
  std::size_t rowOf(std::size_t triangle, std::size_t corner) const;
  double scaleOf(std::size_t triangle) const;
  std::span<const float> unseen() const { return unseen_ ? *unseen_ : std::span<const float>(); }
  std::vector<float> rightSide(std::size_t firstColumn, std::size_t count) const;

  const FitMesh* mesh_;  ///< not null
  std::size_t columns_;
  std::vector<double> stiffness_;     ///< [slot], or empty: 1
  std::vector<std::uint8_t> extent_;  ///< [slot], or empty: all
  std::shared_ptr<const std::vector<float>> unseen_;
  std::vector<double> triangleWeights_;  ///< [triangle], or empty: samples weigh what they say
  std::uint64_t added_ = 0;              ///< samples
  std::vector<TriangleMass> mass_;       ///< [triangle]
  std::vector<float> right_;             ///< [slot][column], or [triangle][corner][column]: sum w b f
  std::shared_ptr<SpillFile> parked_;    ///< has the mass and then the right side, which are empty meanwhile
};

/// The strength that served best over the built-in scenes, see docs/accuracy.md.
constexpr double defaultSmoothing = 0.03;

}  // namespace prelight
