#pragma once

#include <filesystem>
#include <optional>

#include "pictures/picture_sky.h"
#include "prelight/bake.h"

namespace prelight::pictures {

/// Returns the sky that a file's light was baked under: a built-in one, or the recorded file, which is also
/// looked for beside the baked file and must be the same picture. Warns if the sky is not found. Returns
/// nothing if the file records none.
std::optional<PictureSky> bakedSkyOf(DrawingSession& session, const LoadedScene& loaded);

/// Whether a sky, nullptr for none, is the one that a file's light was baked under. `turn`: radians about +Y.
bool isSkyOfBake(const LoadedScene& loaded, const Environment* sky, double turn);

/// Warns if a picture shows another sky than the one that its light was baked under. `rotation` is the
/// picture's, in radians.
void warnOfOtherSky(DrawingSession& session, const LoadedScene& loaded, const Environment& sky,
                    double rotation);

}  // namespace prelight::pictures
