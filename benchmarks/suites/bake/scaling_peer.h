#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suites/bake/bake_suite.h"

namespace prelight::benchmarks {

/// A bake that was made, to be compared with what another baker needs for the same error.
struct FinishedBake {
  std::string name;            ///< name of its case
  std::string technique;       ///< with --sh: transfer of order 3 with a bounce
  std::filesystem::path file;  ///< with the bake, of the scene
  double seconds = 0.0;        ///< from the scene in memory to the values of vertices
  double processorSeconds = 0.0;
};

/// Errors of bakes of one scene, ascending in rays, and of those of a plain baker over Embree at growing
/// numbers of rays a vertex. Results:
/// - "error" of each, over the surface: of AO as it is, of SH relative to its size;
/// - "bake" of each, seconds, and "bake processor". Of Prelight with the ratio to what the other takes to
/// come
///   down to the same error; and, as cases "as Embree at 64 rays", what Prelight takes to come down to the
///   other's errors, with the ratio to that.
/// Empty in a build without Embree.
std::vector<BenchmarkResult> compareWithVertexBaker(const std::string& scene,
                                                    const std::vector<FinishedBake>& bakes,
                                                    std::size_t threads, const BakeOptions& options,
                                                    Progress& progress);

}  // namespace prelight::benchmarks
