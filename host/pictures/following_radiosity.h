#pragma once

#include <memory>

#include "pictures/shaded_scene.h"
#include "radiosity/live_radiosity.h"
#include "viewer/follow/radiosity_follower.h"

namespace prelight::pictures {

/// Radiosity that follows the lights in a window.
struct FollowingRadiosity {
  std::vector<std::string> groups;  ///< names of its light groups; none: the bake has light groups of its own
  LiveRadiosity live;
  viewer::RadiosityFollower follower;

  FollowingRadiosity(const ShadedScene& shaded, const BakeRequest& request, const DeviceOptions& device,
                     const RadiosityLights& shown, std::optional<RadiosityGroups> of);
};

/// Returns the radiosity of a scene whose bake holds it. Returns nullptr for other scenes and, with a
/// warning, if memory does not hold the form factors. `shaded` must outlive it. Nothing is computed before a
/// light changes.
std::unique_ptr<FollowingRadiosity> followingRadiosity(DrawingSession& session, const PictureRequest& asked,
                                                       const ShadedScene& shaded);

}  // namespace prelight::pictures
