#pragma once

#include <span>

#include "prelight/progress.h"
#include "prelight/transfer.h"

namespace prelight {

/// Implements compress() of prelight/transfer.h. Throws Interrupted; unfinished work is kept.
CompressedTransfer compress(const HarmonicTransfer& transfer, const CompressionRequest& request,
                            std::span<const double> vertexWeights, const Progress& progress);

}  // namespace prelight
