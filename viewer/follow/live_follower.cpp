#include "viewer/follow/live_follower.h"

#include <algorithm>

#include "viewer/follow/view_changes.h"
#include "viewer/frame/renderer.h"

namespace prelight::viewer {

LiveFollower::LiveFollower(LiveLight& live, const GlobalIllumination& start)
    : live_(live), map_(start.indirect), photons_(start.photons), filter_(start.caustics.filter) {}

bool LiveFollower::update(const FollowedView& view) {
  tellChanges(view, live_);
  if (view.eye) live_.setEye(*view.eye);
  Progress quiet;
  frame_ = live_.advance(quiet);
  if (frame_.shownChanged) {
    std::fill(map_.values.begin(), map_.values.end(), 0.0f);
    if (!live_.indirect().empty()) setIrradiance(live_, map_);
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
  const Caustics found = caustics();
  renderer.update(shading(), {.indirect = indirect(), .caustics = &found});
}

}  // namespace prelight::viewer
