#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "prelight/device.h"
#include "prelight/picture.h"

namespace prelight::cli {

class Session;
struct PictureOptions;
struct ShadedScene;

/// What lights a picture with all light: an even sky where nothing else gives light.
struct PictureLights {
  std::vector<Light> lights;
  std::optional<Environment> sky;
};

PictureLights pictureLights(const ShadedScene& shaded);

/// The device that the options ask for.
Device openDevice(Session& session, const PictureOptions& options);

/// Light that follows what moves in a window, and what it refers to.
struct FollowingLight {
  std::optional<Environment> sky;
  std::optional<Device> device;
  std::optional<LiveLight> light;
};

/// Indirect light and caustics of global illumination, under the picture's lights.
GlobalIllumination drawnGlobalIllumination(Session& session, const PictureOptions& options,
                                           const ShadedScene& shaded);

/// The same light, able to follow what moves, a little a frame.
std::unique_ptr<FollowingLight> followingLight(Session& session, const PictureOptions& options,
                                               const ShadedScene& shaded);

}  // namespace prelight::cli
