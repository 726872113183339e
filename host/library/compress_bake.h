#pragma once

#include <span>
#include <string>
#include <vector>

#include "compress/quantized_occluders.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"

namespace prelight {

/// Compresses the SH transfer of a bake, which must hold some, wherever it is. `surface`: of each vertex.
/// Returns what that changed, for people. Throws Interrupted; what takes long is kept.
std::vector<std::string> compressTransfer(const CompressionRequest& compression,
                                          std::span<const double> surface, Bake& bake,
                                          const Progress& progress = Progress());

/// The occluders of a bake, which must hold some, become what a reader of the file will get. Appends what
/// that changed.
QuantizedOccluders quantizeBaked(const CompiledScene& scene, Bake& bake, std::vector<std::string>& notes);

}  // namespace prelight
