#pragma once

#include <filesystem>
#include <optional>

#include "cli/picture_sky.h"
#include "prelight/bake.h"

namespace prelight::cli {

/// What a baked file at `output` records of a sky that was asked for.
BakedSky recordOf(const std::filesystem::path& asked, const Environment& sky, double rotation,
                  const std::filesystem::path& output);

/// The sky that a file's light was baked under: a built-in one, or the file that the record names, beside the
/// baked file, too, where it is the same picture. A sky that is not found is warned of. Nothing where the
/// file records none.
std::optional<PictureSky> bakedSkyOf(Session& session, const LoadedScene& loaded);

/// Warns where a picture shows another sky than the one that its light was baked under. `rotation`: radians,
/// of the picture's.
void warnOfOtherSky(Session& session, const LoadedScene& loaded, const Environment& sky, double rotation);

}  // namespace prelight::cli
