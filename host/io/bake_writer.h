#pragma once

#include <nlohmann/json.hpp>

#include "compress/quantized_occluders.h"
#include "io/baked_ranges.h"
#include "scene/gltf/gltf_document.h"
#include "transfer/bake.h"

namespace prelight {

/// The entry of PRELIGHT_transfer for one primitive: what was baked at its vertices, as accessors that are
/// appended to the document. docs/file-format.md has every member. `occluders`, where given, take the place
/// of the bake's.
nlohmann::ordered_json bakeToJson(GltfDocument& document, const CompiledScene& scene, const Bake& bake,
                                  const PrimitiveRanges& ranges, const QuantizedOccluders* occluders);

/// About what bakeToJson() appends in all, without what is compressed, animated or in light maps.
std::size_t storedBytes(const Bake& bake);

/// The members of the root's extension that vertices share: names of light groups, times of keys,
/// compression's tables.
void addSharedData(GltfDocument& document, const Bake& bake, const QuantizedOccluders* occluders,
                   nlohmann::ordered_json& root);

}  // namespace prelight
