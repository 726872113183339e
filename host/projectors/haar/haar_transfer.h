#pragma once

#include "prelight/bake.h"
#include "prelight/progress.h"
#include "projectors/slot_transfer.h"
#include "projectors/haar/texel_transfer.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Wavelet transfer of every vertex, sparse up to a relative L2 error of `error` a row. The direct part has
/// the full detail of `direct`; what bounces add is smooth in the direction of the light, and comes from the
/// SH transfer of as many bands as that has (docs/wavelets.md has what this leaves out). `fitted` is the
/// front's solution.
HaarTransfer makeHaarTransfer(const FitMesh& mesh, const TexelTransfer& direct, const SlotTransfer& transfer,
                              std::span<const float> fitted, int faceSize, double error, Progress& progress);

}  // namespace prelight
