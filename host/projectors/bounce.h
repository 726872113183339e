#pragma once

#include <vector>

#include "cast/caster.h"
#include "prelight/progress.h"
#include "projectors/side_cast.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// One cast side of the surface and its transfer of the current bounce, [slot][3][column].
struct BounceSide {
  const SideCast* cast = nullptr;
  std::vector<float> transfer;
};

/// Replaces each side's transfer by that of the next bounce: every stored row gathers albedo x transfer of
/// what its rays hit, and the vertices are fitted to the rows. No ray is cast. `back` may be null: nothing
/// sees a back.
void bounceOnce(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                std::size_t columnsPerChannel, BounceSide& front, BounceSide* back, Progress& progress);

}  // namespace prelight
