#pragma once

#include <cstdint>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "prelight/request.h"

namespace prelight::benchmarks {

/// Tracing and nothing else.
struct TracingCost {
  std::uint64_t rays = 0;
  double seconds = 0.0;
  double processorSeconds = 0.0;  ///< processor time of this process
};

/// Traces the rays that a bake of this request begins with, in its own blocks and order: whole passes over
/// the surface's fronts, as many as have `enough` rays or as the bake has, at least one. What generates them
/// is not counted. A pass of a bake may leave out rays that were found to be of no use; these do not. Each
/// block is traced `rounds` (>= 1) times, of which the quickest counts. Throws Interrupted.
TracingCost traceRaysAlone(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer,
                           std::uint64_t enough, int rounds, const Progress& progress);

}  // namespace prelight::benchmarks
