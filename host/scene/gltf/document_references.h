#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/gltf/gltf_document.h"

namespace prelight {

enum class Reference : std::uint8_t { Accessor, BufferView };

/// Calls visit(index) for each reference in a document's JSON to an accessor or a buffer view; it may change
/// the index. glTF and its extensions name such members consistently, except the property tables of
/// EXT_structural_metadata; attributes and morph targets are objects all of whose members are accessors.
/// Extras contain no references.
void forEachReference(nlohmann::ordered_json& json, Reference kind,
                      const std::function<void(nlohmann::ordered_json& index)>& visit);

/// Returns the accessors or buffer views that are referred to.
std::set<std::size_t> referencesIn(nlohmann::ordered_json& json, Reference kind);

/// Removes unreferenced accessors, then buffer views, then their bytes. The remaining ones keep their order.
/// Nothing is removed if the document uses an extension that is not known, which may refer to anything.
void removeUnused(GltfDocument& document);

}  // namespace prelight
