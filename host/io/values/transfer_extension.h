#pragma once

#include <optional>

#include "scene/gltf/json_cursor.h"

namespace prelight {

/// The name of the glTF extension that holds baked data.
constexpr const char* transferExtensionName = "PRELIGHT_transfer";

/// Returns the PRELIGHT_transfer object of a glTF object, if it has one.
std::optional<JsonCursor> transferExtension(const JsonCursor& object);

}  // namespace prelight
