#pragma once

#include <nlohmann/json.hpp>

#include "export/raw_arrays.h"
#include "prelight/bake.h"

namespace prelight {

/// Add arrays named NAME.* of vertex transfer whose numbers need explanation, and return the further data
/// that a program needs to use them.
nlohmann::ordered_json addRawWavelets(const HaarTransfer& haar, RawArrays& arrays);
nlohmann::ordered_json addRawOccluders(const OccluderTransfer& occluders, RawArrays& arrays);
nlohmann::ordered_json addRawCompressed(const CompressedTransfer& sh, RawArrays& arrays);

}  // namespace prelight
