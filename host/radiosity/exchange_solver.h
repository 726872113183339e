#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "device/kernel.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "radiosity/form_factors.h"
#include "shared/radiosity_types.h"

namespace prelight {

/// The radiosity equation of a scene on the device. kernels/radiosity/solve_kernels.cl describes the layout.
class ExchangeSystem {
 public:
  /// The arguments are not kept.
  ExchangeSystem(DeviceContext& device, const CompiledScene& scene, const RadiosityElements& elements,
                 const FormFactors& factors);

  std::uint32_t size() const { return size_; }
  std::uint32_t perSide() const { return perSide_; }

  /// Returns the largest share of incident light that any element reflects or transmits in any channel. It
  /// bounds the spectrum.
  double greatestAlbedo() const { return greatestAlbedo_; }

  DeviceContext& device() const { return device_; }

  /// Returns the build options of the solver's kernels.
  const BuildOptions& options() const { return options_; }

  const Buffer<std::uint32_t>& rowStart() const { return rowStart_; }
  const Buffer<std::uint32_t>& columns() const { return columns_; }
  const Buffer<float>& values() const { return values_; }
  const Buffer<float>& scale() const { return scale_; }
  const Buffer<float>& areas() const { return areas_; }
  const Buffer<glm::vec4>& albedo() const { return albedo_; }
  const Buffer<glm::vec4>& transmission() const { return transmission_; }

 private:
  DeviceContext& device_;
  std::uint32_t size_;
  std::uint32_t perSide_;
  double greatestAlbedo_ = 0.0;
  Buffer<std::uint32_t> rowStart_;
  Buffer<std::uint32_t> columns_;
  Buffer<float> values_;
  Buffer<float> scale_;
  Buffer<float> areas_;
  Buffer<glm::vec4> albedo_;
  Buffer<glm::vec4> transmission_;
  BuildOptions options_;
};

/// Returns the transmission of light from the other side, [element]; all are 0 if nothing is translucent.
std::vector<glm::vec4> transmissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                              std::uint32_t count);

/// Solves the radiosity equation iteratively for all three channels together:
///   Jacobi        all rows from the last iterate;
///   Chebyshev     Jacobi's iteration, accelerated by the bound that the greatest albedo sets on the spectrum
///                 (Golub and Varga 1961): about the square root of its iterations;
///   Gauss-Seidel  in 32 blocks of consecutive rows, one after another: rows use the new values of earlier
///                 blocks, and the last iterate within their block (neighbours hardly see each other);
///   Southwell     the row with the most unsent power first, in one work-group.
/// All orders are fixed, so that results depend on neither threads nor chance.
class ExchangeSolver {
 public:
  /// `system` must outlive the solver.
  explicit ExchangeSolver(const ExchangeSystem& system);

  /// Sets the direct light of every element, W/m2, w unused. The last irradiance remains as the initial
  /// value; at the first call, and if the direct light is zero, it is the direct light.
  void setDirect(const std::vector<glm::vec4>& direct);

  /// Sets the initial irradiance to the direct light.
  void restart();

  /// Sets the initial irradiance, [element]. Must follow setDirect().
  void startFrom(const std::vector<glm::vec4>& irradiance);

  /// Iterates until the residual is below `tolerance` or for `maxSweeps`. With `exactCurve` the residual is
  /// measured after every sweep, which doubles the cost; otherwise the curve shows the changes by sweeps,
  /// which equal or approximate the previous residuals. Throws Interrupted.
  SolveReport solve(RadiosityMethod method, double tolerance, double maxSweeps, Progress& progress,
                    bool exactCurve = false);

  /// Returns the irradiance, [element], W/m2.
  std::vector<glm::vec4> irradiance() const { return irradiance_.read(); }

 private:
  void gather(std::uint32_t first, std::uint32_t count);
  void reflect(std::uint32_t first, std::uint32_t count);
  void measure();
  template <typename State>
  void exchange(State& state, SolveReport& report, bool& measured);
  double norm(const Buffer<glm::vec4>& values);
  double sweep(RadiosityMethod method);
  double jacobi();
  double chebyshev();
  double gaussSeidel();
  double southwell();

  const ExchangeSystem& system_;
  DeviceContext& device_;
  bool started_ = false;
  double directNorm_ = 0.0;
  double weight_ = 1.0;         ///< weight of Chebyshev acceleration
  bool residualKnown_ = false;  ///< whether Southwell's residual and ranks are up to date
  double goal_ = 0.0;           ///< norm below which the residual must fall, W
  Buffer<glm::vec4> direct_;
  Buffer<glm::vec4> irradiance_;
  Buffer<glm::vec4> exitance_;
  Buffer<glm::vec4> residual_;
  Buffer<glm::vec4> previous_;
  Buffer<float> unsent_;
  Buffer<glm::vec4> sums_;
  Buffer<std::uint32_t> taken_;

  using Count = std::uint32_t;
  using Floats = Buffer<float>;
  using Numbers = Buffer<std::uint32_t>;
  using Colors = Buffer<glm::vec4>;
  Kernel<Count, Count, Numbers, Numbers, Floats, Floats, Colors, Colors, Colors, Colors> gather_;
  Kernel<Count, Numbers, Numbers, Floats, Floats, Colors, Colors, Colors, Colors> measure_;
  Kernel<Count, Count, Count, Colors, Colors, Colors, Colors> reflect_;
  Kernel<Count, float, Colors, Colors, Colors> accelerate_;
  Kernel<Count, Floats, Colors, Colors> sum_;
  Kernel<Count, Count, Floats, Colors, Colors, Colors, Floats> rank_;
  Kernel<device::RelaxStep, Numbers, Numbers, Floats, Floats, Floats, Colors, Colors, Colors, Colors, Floats,
         Numbers>
      relax_;
  Kernel<Count, Colors, Colors, Floats> takeUnsendable_;
  Kernel<Count, Colors, Colors> takeRest_;
};

}  // namespace prelight
