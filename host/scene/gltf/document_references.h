#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/gltf/gltf_document.h"

namespace prelight {

enum class Reference : std::uint8_t { Accessor, BufferView };

/// Calls visit(index) for everything in a document's JSON that refers to an accessor or a buffer view; it may
/// change the index. glTF and its extensions name such members alike everywhere; attributes and morph targets
/// are objects whose every member is an accessor. Extras refer to nothing.
void forEachReference(nlohmann::ordered_json& json, Reference kind,
                      const std::function<void(nlohmann::ordered_json& index)>& visit);

/// The accessors or buffer views that anything refers to.
std::set<std::size_t> referencesIn(nlohmann::ordered_json& json, Reference kind);

/// Removes accessors that nothing refers to, then buffer views, then their bytes. Those that stay keep their
/// order.
void removeUnused(GltfDocument& document);

}  // namespace prelight
