#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "prelight/plan.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// [{name, runs, reason}] as the passes come.
nlohmann::ordered_json toJson(std::span<const PlannedPass> passes);

/// {passes, memory}, as a baked file's root holds it (docs/file-format.md).
nlohmann::ordered_json toJson(const Plan& plan);

/// The inverse. Passes of names that there are not are left out. Throws InputError for members of wrong
/// types.
Plan planFromJson(const JsonCursor& json);

}  // namespace prelight
