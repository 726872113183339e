#pragma once

#include <nlohmann/json.hpp>

#include "export/raw_arrays.h"
#include "prelight/bake.h"

namespace prelight {

/// Transfer of vertices whose numbers do not speak for themselves. Each adds arrays named NAME.* to `arrays`
/// and returns what else a program has to know to use them.
nlohmann::ordered_json addRawWavelets(const HaarTransfer& haar, RawArrays& arrays);
nlohmann::ordered_json addRawOccluders(const OccluderTransfer& occluders, RawArrays& arrays);
nlohmann::ordered_json addRawCompressed(const CompressedTransfer& sh, RawArrays& arrays);

}  // namespace prelight
