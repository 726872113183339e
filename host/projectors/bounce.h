#pragma once

#include <vector>

#include "cast/caster.h"
#include "prelight/progress.h"
#include "projectors/side_cast.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Uploads transfer of the slots and of their backs, [slot][3][column], as what surfaces send next. No backs:
/// an empty vector.
void sendTransfer(const FitMesh& mesh, Caster& caster, const std::vector<float>& fronts,
                  const std::vector<float>& backs);

/// What a side's slots receive of the transfer that was sent, [slot][3][column], through the side's stored
/// rows. `columns` is that of all channels together.
std::vector<float> receiveTransfer(Caster& caster, const SideCast& side, std::size_t columns,
                                   Progress& progress);

}  // namespace prelight
