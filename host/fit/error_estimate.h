#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fit/sample_records.h"
#include "fit/vertex_fit.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// A fit whose first column is AO less 1, its equations and their solution, which outlive the estimate.
struct AoFit {
  const VertexFit& fit;
  const NormalEquations& equations;  ///< of the fit
  std::span<const float> values;     ///< [slot][columns], fitted
  std::size_t columns = 1;
};

struct ErrorEstimate {
  std::vector<double> slots;  ///< standard error of AO at every slot, averaged with its neighbours
  double rms = 0.0;           ///< over the surface, of the interpolated value
  double max = 0.0;           ///< at the worst slot
};

/// How an estimate is made.
struct ErrorEffort {
  bool halfOfTheGroups = false;  ///< at a time: in less memory, with the same result
  /// Of conjugate gradients, towards what leaving a group out does. One makes it a multiple of what the
  /// group's residuals do, the best one over the surface.
  int stepsWithoutGroups = 5;
  const Progress* progress = nullptr;  ///< as SolveLimits
};

/// Standard error of the AO fitted to `records`, from the scatter of groups of passes. Two estimators bracket
/// it: what the residuals of each group alone would move the result by (a sandwich, too small where the fit
/// follows its own noise), and what leaving each group out does move it by (a jackknife, too large there,
/// because fewer samples fit worse). Their geometric mean is taken: with a sample of leverage h, whose
/// squared residual r^2 has the mean (1 - h) sigma^2, it stands between HC0 = r^2 and HC3 = r^2 / (1 - h)^2
/// as HC2 = r^2 / (1 - h), whose mean is sigma^2 (MacKinnon and White 1985). `all` is the fit to the records;
/// `areas` are the triangles', m2; of `receivers` in all, the records are a representative part.
ErrorEstimate estimateAoError(const FitMesh& mesh, const AoFit& all, const std::vector<double>& areas,
                              const SampleRecords& records, std::uint64_t receivers, bool independent,
                              const ErrorEffort& effort = {});

}  // namespace prelight
