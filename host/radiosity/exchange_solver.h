#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/bake.h"
#include "prelight/progress.h"
#include "radiosity/exchange_system.h"
#include "shared/radiosity_types.h"

namespace prelight {

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
