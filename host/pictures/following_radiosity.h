#pragma once

#include <memory>

#include "pictures/shaded_scene.h"
#include "radiosity/live_radiosity.h"
#include "viewer/radiosity_follower.h"

namespace prelight::pictures {

/// Radiosity that follows the lights of a window.
struct FollowingRadiosity {
  std::vector<std::string> groups;  ///< of its lights; none where the bake has light groups of its own
  LiveRadiosity live;
  viewer::RadiosityFollower follower;

  FollowingRadiosity(const ShadedScene& shaded, const BakeRequest& request, const DeviceOptions& device,
                     const RadiosityLights& shown, std::optional<RadiosityGroups> of);
};

/// For a scene whose bake holds radiosity; nullptr for others, and, with a warning, where memory does not
/// hold the form factors. `shaded` outlives it. Computes nothing before a light changes.
std::unique_ptr<FollowingRadiosity> followingRadiosity(DrawingSession& session, const PictureRequest& asked,
                                                       const ShadedScene& shaded);

}  // namespace prelight::pictures
