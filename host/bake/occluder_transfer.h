#pragma once

#include <vector>

#include "bake/caster.h"
#include "bake/fit_mesh.h"
#include "bake/scene_cast.h"
#include "bake/transfer.h"
#include "base/progress.h"
#include "occluders/occluder_groups.h"

namespace prelight {

/// What making vector occluders did.
struct OccluderReport {
  std::uint64_t receivers = 0;  ///< that were aggregated
  double droppedMean = 0.0;     ///< form factor of what was dropped, mean over vertices
  double droppedMost = 0.0;     ///< at one vertex
};

/// Aggregates the stored rows of a cast by occluder; a vertex has the mean of the receivers around it.
/// `accessibility` is AO a slot, in [0,1]: together with it, the form factors of a slot add up to 1 before
/// those below `leastFormFactor` are dropped.
OccluderTransfer makeOccluderTransfer(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                                      const SceneCast& cast, const std::vector<double>& accessibility,
                                      const OccluderGroups& groups, double leastFormFactor,
                                      Progress& progress, OccluderReport& report);

}  // namespace prelight
