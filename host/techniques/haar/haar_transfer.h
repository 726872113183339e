#pragma once

#include "fit/baseline.h"
#include "prelight/bake.h"
#include "prelight/progress.h"
#include "techniques/haar/texel_transfer.h"
#include "techniques/slot_transfer.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Wavelet transfer of every vertex, sparse up to a relative L2 error of `request.error` a row. The direct
/// part has the full detail of `direct`; what bounces add is smooth in the direction of the light, and comes
/// from the SH transfer of as many bands as that has (docs/notes/wavelets.md has what this leaves out).
/// `fitted` is the front's solution.
HaarTransfer makeHaarTransfer(const FitMesh& mesh, const TexelTransfer& direct, const Baseline& baseline,
                              const SlotTransfer& transfer, std::span<const float> fitted,
                              const HaarRequest& request, Progress& progress);

/// The same of transfer that comes by way of SH alone, with as many bands as `transfer` has: `rows` are a
/// side's, [slot][3][column].
HaarTransfer makeThroughHaar(const FitMesh& mesh, const SlotTransfer& transfer, std::span<const float> rows,
                             const HaarRequest& request, Progress& progress);

}  // namespace prelight
