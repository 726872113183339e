#pragma once

#include <optional>

#include "scene/compiled_scene.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/json_cursor.h"
#include "transfer/bake.h"

namespace prelight {

/// Reads what PRELIGHT_transfer holds for the vertices of a scene; nullopt when no node carries any and
/// `expected` is false. Throws InputError when the data does not fit the scene or itself.
std::optional<Bake> readBakedVertices(const GltfDocument& document, const JsonCursor& root,
                                      const CompiledScene& scene, bool expected);

/// The PRELIGHT_transfer object of a glTF object, if it has one.
std::optional<JsonCursor> transferExtension(const JsonCursor& object);

}  // namespace prelight
