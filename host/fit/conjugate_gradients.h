#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "fit/normal_equations.h"
#include "prelight/progress.h"

namespace prelight {

/// When conjugate gradients stop.
struct SolveLimits {
  /// Bound of the preconditioned residual relative to that of the initial value 0; the default is the limit
  /// of single precision.
  double tolerance = 4e-7;
  int iterations = 64;  ///< per start; 10 to 25 suffice where samples are spread well
  std::size_t threads = hardwareThreads();
  /// Whether the residual is recomputed at the end, and the iteration restarted if rounding has made it
  /// deviate.
  bool verified = true;
  const Progress* progress = nullptr;  ///< asked between iterations whether to stop; iterations are kept
};

/// Returns limits for values with noise of a percent or so, which need only half of the iterations.
inline SolveLimits noisyValues() { return {.tolerance = 1e-5, .verified = false}; }

/// Solves the equations of all sampled slots for every column of `values`, [slot][column], whose right-hand
/// sides are replaced by solutions. Each column has its own step sizes: conjugate gradients from 0 in single
/// precision with Jacobi's preconditioner and sums in double precision. Slots without samples are neither
/// read nor written. The result of a column depends neither on other columns nor on the number of threads.
/// Throws Interrupted.
void conjugateGradients(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                        const SolveLimits& limits = {});

}  // namespace prelight
