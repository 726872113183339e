#include "viewer/live_follower.h"

#include <algorithm>

#include "viewer/renderer.h"

namespace prelight::viewer {

LiveFollower::LiveFollower(LiveLight& live, const GlobalIllumination& start)
    : live_(live), map_(start.indirect), photons_(start.photons), filter_(start.caustics.filter) {}

bool LiveFollower::update(const FollowedView& view) {
  changes_.tell(view, live_);
  Progress quiet;
  frame_ = live_.advance(quiet);
  if (frame_.shownChanged) {
    std::fill(map_.values.begin(), map_.values.end(), 0.0f);
    if (!live_.indirect().empty()) setIrradiance(live_.indirect(), map_);
  }
  if (frame_.causticsChanged) photons_ = live_.caustics();
  return frame_.shownChanged || frame_.causticsChanged;
}

void LiveFollower::show(Renderer& renderer) const {
  renderer.updateIndirect(indirect());
  renderer.updateCaustics(caustics());
}

}  // namespace prelight::viewer
