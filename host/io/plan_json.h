#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "prelight/plan.h"
#include "scene/gltf/json_cursor.h"

namespace prelight {

/// Returns [{name, runs, reason}] in the order of the passes.
nlohmann::ordered_json toJson(std::span<const PlannedPass> passes);

/// Returns {passes, memory}, as a baked file's root holds it (docs/file-format.md).
nlohmann::ordered_json toJson(const Plan& plan);

/// Reads a plan. Passes with unknown names are skipped. Throws InputError for members of wrong types.
Plan planFromJson(const JsonCursor& json);

}  // namespace prelight
