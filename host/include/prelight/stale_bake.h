#pragma once

#include <optional>
#include <string>

#include "prelight/load.h"

namespace prelight {

/// Returns a message about changes of a scene since it was baked and the parts of its bake that no longer
/// fit, or nothing if everything fits or the file does not tell.
std::optional<std::string> staleBake(const LoadedScene& scene, const Bake& carried);

}  // namespace prelight
