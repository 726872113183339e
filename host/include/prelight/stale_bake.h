#pragma once

#include <optional>
#include <string>

#include "prelight/load.h"

namespace prelight {

/// What has changed of a scene since its file was baked, and what of the bake that it carries no longer fits
/// it, for people; nothing where all of it does, or the file does not say.
std::optional<std::string> staleBake(const LoadedScene& scene, const Bake& carried);

}  // namespace prelight
