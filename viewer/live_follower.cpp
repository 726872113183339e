#include "viewer/live_follower.h"

#include <algorithm>

#include "viewer/renderer.h"

namespace prelight::viewer {

LiveFollower::LiveFollower(LiveLight& live, const GlobalIllumination& start)
    : live_(live), map_(start.indirect), photons_(start.photons), filter_(start.caustics.filter) {}

/// Lights that the window has added are not the scene's: they shine directly alone.
void LiveFollower::tell(const FollowedView& view) {
  if (view.scene != nullptr) live_.pose(*view.scene);
  // Where the window has them, also those that hang on nodes that have moved.
  const std::size_t known = live_.scene().compiled().lights.size();
  for (std::size_t i = 0; i < std::min(view.lights.size(), known); ++i)
    if (!shinesAs(view.lights[i], live_.scene().compiled().lights[i])) live_.setLight(i, view.lights[i]);
  if (view.skyRotation != live_.skyRotation()) live_.setSkyRotation(view.skyRotation);
}

bool LiveFollower::update(const FollowedView& view) {
  tell(view);
  Progress quiet;
  frame_ = live_.advance(quiet);
  if (frame_.shownChanged) {
    std::fill(map_.values.begin(), map_.values.end(), 0.0f);
    if (!live_.indirect().empty()) setIrradiance(live_.indirect(), map_);
  }
  if (frame_.causticsChanged) {
    photons_ = live_.caustics();
    filterIsOld_ = true;
  }
  const bool filtered = filterIsOld_ && live_.settled();
  if (filtered) {
    filter_ = causticsOf(live_).filter;
    filterIsOld_ = false;
  }
  return frame_.shownChanged || frame_.causticsChanged || filtered;
}

void LiveFollower::show(Renderer& renderer) const {
  renderer.updateIndirect(indirect());
  renderer.updateCaustics(caustics());
}

}  // namespace prelight::viewer
