#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "fit/normal_equations.h"
#include "prelight/progress.h"

namespace prelight {

struct SolveLimits {
  double tolerance = 4e-7;  ///< of the guess's preconditioned residual: as low as single precision goes
  int iterations = 64;      ///< of a start; 10 to 25 do where samples are spread well
  std::size_t threads = hardwareThreads();
  bool verified = true;  ///< whether the residual is computed anew at the end, and the iteration begun anew
                         ///< should rounding have parted the two
  const Progress* progress = nullptr;  ///< is asked whether to stop between iterations, which are kept
};

/// For values that their own noise, of a percent or so, leaves open by far more: half of the iterations.
inline SolveLimits noisyValues() { return {.tolerance = 1e-5, .verified = false}; }

/// Solves the equations of all sampled slots for every column of `values`, [slot][column], right sides that
/// become their solutions, each on its own step sizes: conjugate gradients from 0 in single precision with
/// Jacobi's preconditioner and sums in double precision. Slots without samples are neither read nor written.
/// The result of a column depends neither on the others nor on the number of threads. Throws Interrupted.
void conjugateGradients(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                        const SolveLimits& limits = {});

}  // namespace prelight
