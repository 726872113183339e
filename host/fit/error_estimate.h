#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fit/sample_records.h"
#include "fit/vertex_fit.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// A fit whose first column is AO - 1, with its equations and their solution. All must outlive the estimate.
struct AoFit {
  const VertexFit& fit;
  const NormalEquations& equations;  ///< equations of the fit
  std::span<const float> values;     ///< [slot][columns], fitted
  std::size_t columns = 1;
};

struct ErrorEstimate {
  std::vector<double> slots;  ///< [slot], standard error of AO, averaged with the neighbours
  double rms = 0.0;           ///< RMS of the interpolated value over the surface
  double max = 0.0;           ///< value at the worst slot
};

/// Options of an estimate.
struct ErrorEffort {
  bool halfOfTheGroups = false;  ///< processes half of the groups at a time: less memory, same result
  /// Conjugate-gradient steps towards the change that leaving a group out causes. A single step scales the
  /// change that the group's residuals cause by the factor that fits best over the surface.
  int stepsWithoutGroups = 5;
  const Progress* progress = nullptr;  ///< as in SolveLimits
};

/// Estimates the standard error of the AO fitted to `records` from the scatter of groups of passes. Two
/// estimators bracket it: the change that the residuals of each group alone cause (a sandwich, too small
/// where the fit follows its own noise), and the change that leaving each group out causes (a jackknife, too
/// large there, because fewer samples fit worse). The estimate is their geometric mean. For a sample of
/// leverage h, whose squared residual r^2 has the mean (1 - h) sigma^2, this is HC2 = r^2 / (1 - h), whose
/// mean is sigma^2, between HC0 = r^2 and HC3 = r^2 / (1 - h)^2 (MacKinnon and White 1985). `all` is the fit
/// to the records and `areas` are the triangles', m2. The records are a representative part of `receivers`
/// receivers.
ErrorEstimate estimateAoError(const FitMesh& mesh, const AoFit& all, const std::vector<double>& areas,
                              const SampleRecords& records, std::uint64_t receivers, bool independent,
                              const ErrorEffort& effort = {});

}  // namespace prelight
