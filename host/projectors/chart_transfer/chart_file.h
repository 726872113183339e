#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "io/values/baked_ranges.h"
#include "prelight/transfer.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Member `texels` of a primitive's entry: the light maps of its instances, in their order; its values are
/// appended to the document. Null when the transfer has none of the primitive.
nlohmann::ordered_json chartsToJson(GltfDocument& document, const ChartTransfer& transfer,
                                    const CompiledScene& scene, const PrimitiveRanges& ranges);

/// Reads it back and adds its maps to `transfer`; the first one sets the order, channels and bounces. `root`
/// is the whole glTF object. Throws InputError when it does not fit the scene, itself or the others.
void readCharts(const GltfDocument& document, const JsonCursor& root, const JsonCursor& json,
                const CompiledScene& scene, const PrimitiveRanges& ranges,
                std::optional<ChartTransfer>& transfer);

/// Into the order of the scene's primitives.
void sortMaps(ChartTransfer& transfer);

}  // namespace prelight
