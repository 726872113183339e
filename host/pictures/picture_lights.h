#pragma once

#include <optional>
#include <vector>

#include "library/open_scene.h"
#include "prelight/scene.h"

namespace prelight::pictures {

/// Returns whether area lights or cookies, which are drawn and not traced, are among them.
bool anyDrawnOnly(const std::optional<std::vector<Light>>& lights);

/// Moves area lights from the list into the scene as emissive surfaces, for commands that trace light.
/// Returns true if there were any. Throws UsageError for cookies, which are not traced.
bool makeSurfaces(std::optional<std::vector<Light>>& lights, LoadedScene& loaded);

}  // namespace prelight::pictures
