#pragma once

#include <memory>
#include <optional>

#include "gi/global_illumination.h"
#include "gi/update/live_light.h"
#include "integrators/live_virtual_lights.h"
#include "pictures/picture_request.h"
#include "pictures/session/drawing_session.h"
#include "prelight/device.h"
#include "prelight/picture.h"

namespace prelight::pictures {

struct ShadedScene;

/// Sky and device that light which follows a moving scene refers to.
struct FollowedScene {
  std::optional<Environment> sky;
  std::shared_ptr<const Device> device;
};

/// Global illumination that follows moving objects and lights in a window.
struct FollowingLight : FollowedScene {
  std::optional<LiveLight> light;
};

/// Virtual lights that follow moving objects and lights.
struct FollowingVirtualLights : FollowedScene {
  std::optional<LiveVirtualLights> lights;
};

/// Computes indirect light and caustics of global illumination, under the picture's lights.
GlobalIllumination drawnGlobalIllumination(DrawingSession& session, const PictureRequest& request,
                                           const ShadedScene& shaded);

/// Computes the light of drawnGlobalIllumination() so that it can follow movement, a little per frame.
std::unique_ptr<FollowingLight> followingLight(DrawingSession& session, const PictureRequest& request,
                                               const ShadedScene& shaded);

/// Computes the virtual lights of instant shading, under the picture's lights.
std::unique_ptr<FollowingVirtualLights> followingVirtualLights(DrawingSession& session,
                                                               const PictureRequest& request,
                                                               const ShadedScene& shaded);

}  // namespace prelight::pictures
