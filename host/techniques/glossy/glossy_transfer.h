#pragma once

#include <vector>

#include "cast/caster.h"
#include "cast/side_cast.h"
#include "cast/stored_transport.h"
#include "prelight/progress.h"
#include "techniques/glossy/stored_receivers.h"
#include "techniques/slot_transfer.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// What the front of a scene has been cast for.
struct GlossySource {
  Caster& caster;
  StoredTransport* transport;  ///< nullptr: there are no bounces
  const SideCast& front;
  const Baseline& baseline;  ///< of the front
  const StoredReceivers& receivers;
};

/// Transfer matrices of the fit's slots, [slot][channel][i][j] of `order`. The direct part is exact algebra:
/// the integral of V cos Y_i Y_j over pi is sum_k Gamma_ijk T_k with the diffuse transfer T up to order 2
/// `order` - 1, which `fitted` (the front's solution) holds. Bounces, where `transfer` has any, are gathered
/// from the stored rows.
std::vector<float> makeGlossyMatrices(const CompiledScene& scene, const FitMesh& mesh,
                                      const GlossySource& source, const std::vector<float>& fitted,
                                      const SlotTransfer& transfer, int order, Progress& progress);

}  // namespace prelight
