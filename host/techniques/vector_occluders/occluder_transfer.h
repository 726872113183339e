#pragma once

#include <vector>

#include "occluders/occluder_tree.h"
#include "prelight/transfer.h"
#include "receivers/fit_mesh.h"
#include "techniques/vector_occluders/occluder_means.h"

namespace prelight {

/// Records of all vertices from what is seen around their slots. `accessibility` is AO a slot, in [0,1]:
/// together with it, the form factors of a slot add up to 1. `stored` is ascending, of neededVectors().
OccluderTransfer makeOccluderTransfer(const CompiledScene& scene, const FitMesh& mesh,
                                      const OccluderMeans& means, const std::vector<double>& accessibility,
                                      const OccluderGroups& groups,
                                      const std::vector<OccluderVector>& stored);

}  // namespace prelight
