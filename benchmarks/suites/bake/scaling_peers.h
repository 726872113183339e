#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suites/bake/bake_suite.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "prelight/techniques.h"

namespace prelight::benchmarks {

/// Cost of tracing without anything else.
struct TracingCost {
  std::uint64_t rays = 0;
  double seconds = 0.0;
  double processorSeconds = 0.0;  ///< processor time of this process
};

/// Traces the first rays of a bake of this request, in the bake's blocks and order: whole passes over the
/// front sides of the surface, until there are `enough` rays or the bake has no more, at least one pass.
/// Generating rays is not counted. Unlike passes of a bake, these leave out no rays as useless. Each block is
/// traced `rounds` (>= 1) times, and the fastest counts. Throws Interrupted.
TracingCost traceRaysAlone(const CompiledScene& scene, const BakeRequest& request, Tracer& tracer,
                           std::uint64_t enough, int rounds, const Progress& progress);

/// A finished bake, to be compared with the time that another baker needs for the same error.
struct FinishedBake {
  std::string name;            ///< name of its case
  std::string technique;       ///< its options; with --sh it has transfer of order 3 with a bounce
  std::filesystem::path file;  ///< the scene with its bake
  double seconds = 0.0;        ///< seconds from the loaded scene to the values of vertices
  double processorSeconds = 0.0;
};

/// Returns errors of bakes of one scene, ascending in rays, and of those by a simple baker over Embree at
/// growing numbers of rays per vertex. Results:
/// - "error" of each over the surface: absolute for AO, relative to its size for SH;
/// - "bake" (seconds) and "bake processor" of each. Those of Prelight have the ratio to the time in which the
///   other comes
///   down to the same error. Cases "as Embree at 64 rays" hold the time in which Prelight comes down to the
///   other's error, with the ratio to the other's time.
/// Empty in a build without Embree.
std::vector<BenchmarkResult> compareWithVertexBaker(const std::string& scene,
                                                    const std::vector<FinishedBake>& bakes,
                                                    std::size_t threads, const BakeOptions& options,
                                                    Progress& progress);

}  // namespace prelight::benchmarks
