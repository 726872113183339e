#pragma once

#include <algorithm>

#include "viewer/follow/light_follower.h"

namespace prelight::viewer {

/// Tells light that is live of what is dragged, posed and turned in a window. Lights that the window has
/// added are not the scene's: they shine directly alone.
template <typename Live>
void tellChanges(const FollowedView& view, Live& live) {
  if (view.scene != nullptr) live.pose(*view.scene);
  // Where the window has them, also those that hang on nodes that have moved.
  const std::size_t known = live.scene().compiled().lights.size();
  for (std::size_t i = 0; i < std::min(view.lights.size(), known); ++i)
    if (!shinesAs(view.lights[i], live.scene().compiled().lights[i])) live.setLight(i, view.lights[i]);
  if (view.skyRotation != live.skyRotation()) live.setSkyRotation(view.skyRotation);
}

}  // namespace prelight::viewer
