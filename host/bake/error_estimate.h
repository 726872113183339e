#pragma once

#include <cstdint>
#include <vector>

#include "bake/fit_mesh.h"
#include "bake/surface_sampler.h"
#include "bake/vertex_fit.h"

namespace prelight {

/// What is kept of a receiver after its block: its place, and its open fraction for the error estimate.
struct SampleRecord {
  SurfaceSample sample;
  float open = 0.0f;
  std::uint32_t group = 0;  ///< of the error estimate, below errorGroups
};

/// Passes are dealt to this many groups, whose scatter gives the standard error.
constexpr std::uint32_t errorGroups = 8;

struct ErrorEstimate {
  std::vector<double> slots;  ///< standard error of AO at every slot, averaged with its neighbours
  double rms = 0.0;           ///< over the surface, of the interpolated value
  double max = 0.0;           ///< at the worst slot
};

/// Standard error of the fitted AO: a sandwich estimator clustered by groups of passes. The residuals of each
/// group alone, pushed through the fit, say how far that group would have moved the result. `fitted` is the
/// AO column relative to fully open, [slot].
ErrorEstimate estimateAoError(const FitMesh& mesh, const VertexFit& fit, const std::vector<double>& fitted,
                              const std::vector<SampleRecord>& records);

}  // namespace prelight
