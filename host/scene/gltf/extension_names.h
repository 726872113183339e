#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace prelight {

/// Adds a name to `extensionsUsed` of a glTF object, unless it is listed already.
void useExtensionName(nlohmann::ordered_json& root, std::string_view name);

/// Removes a name from `extensionsUsed` and `extensionsRequired`.
void dropExtensionName(nlohmann::ordered_json& root, std::string_view name);

}  // namespace prelight
