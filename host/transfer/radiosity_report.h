#pragma once

#include <cstdint>
#include <vector>

#include "plan/radiosity_request.h"

namespace prelight {

/// A solution on its way: norms after that much work.
struct ResidualPoint {
  double sweeps = 0.0;    ///< row operations so far over the number of rows
  double seconds = 0.0;   ///< since the start
  double residual = 0.0;  ///< sum of area x |residual| of the strongest channel over that of the direct light
};

struct SolveReport {
  std::vector<ResidualPoint> curve;
  bool converged = false;
  double sweeps() const { return curve.empty() ? 0.0 : curve.back().sweeps; }
  double residual() const { return curve.empty() ? 0.0 : curve.back().residual; }
};

/// What a solution cost and how far it went.
struct RadiosityReport {
  std::uint64_t elements = 0;  ///< that were cast from
  std::uint64_t entries = 0;   ///< of the form-factor rows
  std::uint64_t castRays = 0;
  std::uint64_t directRays = 0;  ///< of all lights so far
  double castSeconds = 0.0;
  double rowSeconds = 0.0;  ///< from counts to form factors
  double directSeconds = 0.0;
  double solveSeconds = 0.0;
  double patchSize = 0.0;
  RadiosityMethod method = RadiosityMethod::GaussSeidel;
  SolveReport solve;  ///< of the last lights
};

}  // namespace prelight
