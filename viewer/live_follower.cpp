#include "viewer/live_follower.h"

#include <algorithm>

namespace prelight::viewer {

namespace {

bool same(const Light& a, const Light& b) {
  return a.type == b.type && a.intensity == b.intensity && a.position == b.position &&
         a.direction == b.direction && a.range == b.range && a.innerConeAngle == b.innerConeAngle &&
         a.outerConeAngle == b.outerConeAngle;
}

}  // namespace

LiveFollower::LiveFollower(LiveLight& live, const FullLight& start)
    : live_(live), map_(start.indirect), photons_(start.photons), filter_(start.filter) {}

/// Lights that the window has added are not the scene's: they shine directly alone.
void LiveFollower::tell(const FollowedView& view) {
  const std::size_t known = std::min(view.lights.size(), live_.scene().compiled().lights.size());
  if (told_) {
    for (std::size_t i = 0; i < std::min(known, lights_.size()); ++i)
      if (!same(view.lights[i], lights_[i])) live_.setLight(i, view.lights[i]);
    for (std::size_t i = 0; i < view.shifts.size(); ++i) {
      const bool moved =
          i < shifts_.size() ? view.shifts[i] != shifts_[i] : view.shifts[i].by != glm::dvec3(0.0);
      if (moved) live_.moveNode(view.shifts[i].node, {glm::dmat3(1.0), view.shifts[i].by});
    }
    if (view.skyRotation != skyRotation_) live_.setSkyRotation(view.skyRotation);
  }
  lights_.assign(view.lights.begin(), view.lights.begin() + static_cast<std::ptrdiff_t>(known));
  shifts_.assign(view.shifts.begin(), view.shifts.end());
  skyRotation_ = view.skyRotation;
  told_ = true;
}

bool LiveFollower::update(const FollowedView& view) {
  tell(view);
  Progress quiet;
  frame_ = live_.advance(quiet);
  if (frame_.shownChanged) {
    std::fill(map_.values.begin(), map_.values.end(), 0.0f);
    setIrradiance(live_.indirect(), map_);
  }
  if (frame_.causticsChanged) photons_ = live_.caustics();
  return frame_.shownChanged || frame_.causticsChanged;
}

}  // namespace prelight::viewer
