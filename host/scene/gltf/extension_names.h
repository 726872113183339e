#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace prelight {

/// Adds a name to `extensionsUsed` of a glTF object, once.
void useExtensionName(nlohmann::ordered_json& root, std::string_view name);

/// Takes a name out of `extensionsUsed` and `extensionsRequired`.
void dropExtensionName(nlohmann::ordered_json& root, std::string_view name);

}  // namespace prelight
