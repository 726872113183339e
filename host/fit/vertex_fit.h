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

/// Weighted least-squares fit of per-vertex values to samples inside the triangles. It minimises
///   sum_s w_s |sum_i b_i(s) x_i - f_s|^2 + lambda |L x|^2,
/// where L is the graph Laplacian scaled by each slot's weight. The fitted function is the one that a
/// rasteriser will interpolate (Kavan et al. 2011, "Least Squares Vertex Baking").
class VertexFit {
 public:
  /// Makes a fit with `columns` values per sample.
  VertexFit(const FitMesh& mesh, std::size_t columns);

  /// Makes a fit for unevenly dense samples: all samples of a triangle together have the weight in
  /// `triangleWeights`, however many there are, so that the fit still minimises the error over the surface.
  /// It keeps sums per triangle corner, which takes six times the memory.
  VertexFit(const FitMesh& mesh, std::size_t columns, std::vector<double> triangleWeights);

  /// Adds samples with their values, [sample][column]. Consecutive samples of one triangle are summed in
  /// double precision before they are added to the single-precision totals.
  void add(std::span<const SurfaceSample> samples, std::span<const double> values);
  void add(std::span<const SurfaceSample> samples, std::span<const float> values);
  void add(const SurfaceSample& sample, std::span<const double> values) {
    add(std::span(&sample, 1), values);
  }

  std::size_t columns() const { return columns_; }

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Moves the sums to a file. Solving reads them from there temporarily, and fetch() brings them back for
  /// further samples. Fits with triangle weights stay in memory, because they are read per sample.
  void park();
  void fetch();

  /// Returns the weight of a sample in the fit.
  double weightOf(const SurfaceSample& sample) const { return sample.weight * scaleOf(sample.triangle); }

  /// Returns the solution, [slot][column]. Slots without a sample near are filled from their neighbours, or
  /// are 0 if these have none.
  std::vector<float> solve(double lambda, const SolveLimits& limits = {}) const;

  /// Returns the solution of a single column, [slot].
  std::vector<float> solveColumn(double lambda, std::size_t column, const SolveLimits& limits = {}) const;

  /// Adds to a right-hand side for solve(), [slot][column], the contribution of samples of this fit with
  /// values for other columns, [sample][column].
  void addTo(std::span<float> rightSide, std::span<const SurfaceSample> samples,
             std::span<const float> values) const;

  /// Returns the equations of solve(), for callers that need rows of their inverse or several solutions.
  NormalEquations equations(double lambda) const;

  /// Solve equations() for all columns of this fit, [slot][column]; for one column, [slot]; or for another
  /// right-hand side, [slot][column], whose memory receives the solution.
  std::vector<float> solve(const NormalEquations& equations, const SolveLimits& limits = {}) const;
  std::vector<float> solveColumn(const NormalEquations& equations, std::size_t column,
                                 const SolveLimits& limits = {}) const;
  std::vector<float> solve(const NormalEquations& equations, std::vector<float> rightSide,
                           std::size_t columns, const SolveLimits& limits = {}) const;

  /// Multiplies the smoothing of each slot, [slot], > 0, in later solutions (see stiffnessOf()).
  void stiffen(std::vector<double> stiffness) { stiffness_ = std::move(stiffness); }
  const std::vector<double>& stiffness() const { return stiffness_; }

  /// Sets the weight, [triangle], that added samples lack: their surface is smoothed like any other. The
  /// weights may still grow afterwards; nullptr: none.
  void leaveOut(std::shared_ptr<const std::vector<float>> unseen) { unseen_ = std::move(unseen); }

  /// Limits filling of slots without a sample near to those marked in `extent`, [slot]; empty: all are
  /// filled.
  void extendTo(std::vector<std::uint8_t> extent) { extent_ = std::move(extent); }
  const std::vector<std::uint8_t>& extent() const { return extent_; }

 private:
  std::size_t massBytes() const { return mesh_->triangles.size() * sizeof(TriangleMass); }
  std::vector<TriangleMass> parkedMass() const;
  std::vector<float> parkedRight() const;
  std::size_t rowOf(std::size_t triangle, std::size_t corner) const;
  template <typename Value>
  void addValues(std::span<const SurfaceSample> samples, std::span<const Value> values);
  double scaleOf(std::size_t triangle) const;
  std::span<const float> unseen() const { return unseen_ ? *unseen_ : std::span<const float>(); }
  std::vector<float> rightSide(std::size_t firstColumn, std::size_t count) const;

  const FitMesh* mesh_;  ///< not null
  std::size_t columns_;
  std::vector<double> stiffness_;     ///< [slot]; empty: 1
  std::vector<std::uint8_t> extent_;  ///< [slot]; empty: all
  std::shared_ptr<const std::vector<float>> unseen_;
  std::vector<double> triangleWeights_;  ///< [triangle]; empty: samples have their own weights
  std::uint64_t added_ = 0;              ///< number of samples
  std::vector<TriangleMass> mass_;       ///< [triangle]
  std::vector<float> right_;             ///< [slot][column], or [triangle][corner][column]: sum w b f
  /// File with the mass, then the right side, which are empty in memory meanwhile.
  std::shared_ptr<SpillFile> parked_;
};

/// Smoothing strength that works best over the built-in scenes, see docs/notes/accuracy.md.
constexpr double defaultSmoothing = 0.03;

/// Fills slots that the equations do not determine, as no sample is near, with the means of their neighbours'
/// values, ring by ring away from the sampled slots, and smooths them a little. Slots that triangles connect
/// to no sampled slot become 0. `extent`, [slot], marks the slots that need values; empty: all. `x` is
/// [slot][column].
void extendFit(const FitMesh& mesh, const NormalEquations& equations, std::span<const std::uint8_t> extent,
               std::size_t columns, std::vector<float>& x);

/// Returns by how many times each slot of a fit may be smoothed more strongly, 1 to mostStiffness: more where
/// the curvature of the fitted function is within its noise. With a prior of variance t^2 for the Laplacian
/// and noise of variance s^2 in it, the best strength is proportional to s^2 / t^2, as in Wiener's filter.
///
/// `laplacian` is that of the fitted values, [slot] (NormalEquations::laplacian). `standardError` is that of
/// the values, [slot].
std::vector<double> stiffnessOf(const FitMesh& mesh, std::span<const double> laplacian,
                                std::span<const double> standardError);

constexpr double mostStiffness = 10.0;

}  // namespace prelight
