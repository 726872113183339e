#pragma once

#include <nlohmann/json.hpp>

namespace prelight {

/// Adds a name to `extensionsUsed` of a glTF object, once.
void useExtensionName(nlohmann::ordered_json& root, const char* name);

/// Takes a name out of `extensionsUsed` and `extensionsRequired`.
void dropExtensionName(nlohmann::ordered_json& root, const char* name);

}  // namespace prelight
