#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/suite.h"

namespace prelight::benchmarks {

/// A bake that was made, to be compared with what another baker needs for the same error.
struct FinishedBake {
  std::string name;            ///< of its case
  std::string technique;       ///< with --sh: transfer of order 3 with a bounce
  std::filesystem::path file;  ///< with the bake, of the scene
  double seconds = 0.0;        ///< from the scene in memory to the values of vertices
};

/// Errors of bakes of one scene, ascending in rays, and of those of a plain baker over Embree at growing
/// numbers of rays a vertex. Results:
/// - "error", over the surface: of AO as it is, of SH relative to its size;
/// - "bake", seconds: of Prelight with the ratio to the seconds in which the other comes down to the same
/// error. Empty in a build without Embree.
std::vector<BenchmarkResult> compareWithVertexBaker(const std::string& scene,
                                                    const std::vector<FinishedBake>& bakes,
                                                    std::size_t threads, const BenchmarkOptions& options,
                                                    Progress& progress);

}  // namespace prelight::benchmarks
