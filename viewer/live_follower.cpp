#include "viewer/live_follower.h"

#include <algorithm>

#include "viewer/renderer.h"

namespace prelight::viewer {

LiveFollower::LiveFollower(LiveLight& live, const GlobalIllumination& start)
    : live_(live), map_(start.indirect), photons_(start.photons), filter_(start.caustics.filter) {}

/// Lights that the window has added are not the scene's: they shine directly alone.
void LiveFollower::tell(const FollowedView& view) {
  for (std::size_t i = 0; i < view.shifts.size(); ++i) {
    const glm::dvec3 before = i < shifts_.size() ? shifts_[i].by : glm::dvec3(0.0);
    if (view.shifts[i].by != before)
      live_.moveNode(view.shifts[i].node, {glm::dmat3(1.0), view.shifts[i].by});
  }
  shifts_.assign(view.shifts.begin(), view.shifts.end());
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
  if (frame_.causticsChanged) photons_ = live_.caustics();
  return frame_.shownChanged || frame_.causticsChanged;
}

void LiveFollower::show(Renderer& renderer) const {
  renderer.updateIndirect(indirect());
  renderer.updateCaustics(caustics());
}

}  // namespace prelight::viewer
