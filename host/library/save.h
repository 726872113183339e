#pragma once

#include <span>
#include <string>
#include <vector>

#include "compress/quantized_occluders.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"

namespace prelight {

/// Compresses all SH transfer of a bake, which must hold some. `surface` is the area of each vertex. Returns
/// messages about sizes and errors. Throws Interrupted; unfinished work is kept.
std::vector<std::string> compressTransfer(const CompressionRequest& compression,
                                          std::span<const double> surface, Bake& bake,
                                          const Progress& progress = Progress());

/// Quantises the occluders of a bake, which must hold some, and replaces them by the decoded ones that a
/// reader of the file gets. Appends messages about sizes and errors.
QuantizedOccluders quantizeBaked(const CompiledScene& scene, Bake& bake, std::vector<std::string>& notes);

}  // namespace prelight
