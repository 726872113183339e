#pragma once

#include <filesystem>
#include <memory>

#include "prelight/scene.h"

namespace prelight::viewer {

/// A photometric profile of LM-63. Throws InputError.
std::shared_ptr<const LightProfile> readProfile(const std::filesystem::path& file);

/// A picture for a spot light to project (scene/light_profile.h). Throws InputError.
std::shared_ptr<const Picture> readCookie(const std::filesystem::path& file);

}  // namespace prelight::viewer
