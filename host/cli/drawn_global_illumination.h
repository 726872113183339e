#pragma once

#include <memory>
#include <optional>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "prelight/device.h"
#include "prelight/picture.h"

namespace prelight::cli {

class Session;
struct PictureOptions;
struct ShadedScene;

/// What light that follows refers to.
struct FollowedScene {
  std::optional<Environment> sky;
  std::optional<Device> device;
};

/// Opens the device of a followed scene and gives it the picture's sky; returns the scene under the picture's
/// lights.
CompiledScene followUnderLights(Session& session, const PictureOptions& options, const ShadedScene& shaded,
                                FollowedScene& followed);

/// Light that follows what moves in a window.
struct FollowingLight : FollowedScene {
  std::optional<LiveLight> light;
};

/// Indirect light and caustics of global illumination, under the picture's lights.
GlobalIllumination drawnGlobalIllumination(Session& session, const PictureOptions& options,
                                           const ShadedScene& shaded);

/// The same light, able to follow what moves, a little a frame.
std::unique_ptr<FollowingLight> followingLight(Session& session, const PictureOptions& options,
                                               const ShadedScene& shaded);

}  // namespace prelight::cli
