#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "fit/normal_equations.h"

namespace prelight {

struct SolveLimits {
  double tolerance = 4e-7;  ///< of the guess's preconditioned residual: as low as single precision goes
  int iterations = 64;      ///< 10 to 25 do where samples are spread well
  std::size_t threads = hardwareThreads();
};

/// Solves the equations of all sampled slots for every column of `values`, [slot][column], right sides that
/// become their solutions, each on its own step sizes: conjugate gradients from 0 in single precision with
/// Jacobi's preconditioner and sums in double precision. The recursive residual is replaced by the true one
/// at the end, and the iteration begun anew should they have parted. Slots without samples are neither read
/// nor written. The result does not depend on the number of threads.
void conjugateGradients(const NormalEquations& equations, std::span<float> values, std::size_t columns,
                        const SolveLimits& limits = {});

}  // namespace prelight
