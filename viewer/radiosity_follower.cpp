#include "viewer/radiosity_follower.h"

#include <algorithm>
#include <utility>

#include "viewer/renderer.h"

namespace prelight::viewer {

RadiosityFollower::RadiosityFollower(LiveRadiosity& live, RadiosityLights shown)
    : live_(live), told_(std::move(shown)) {}

bool RadiosityFollower::differs(const FollowedView& view) const {
  return view.skyRotation != told_.skyRotation ||
         !std::equal(view.lights.begin(), view.lights.end(), told_.punctual.begin(), told_.punctual.end(),
                     shinesAs);
}

bool RadiosityFollower::update(const FollowedView& view) {
  if (differs(view)) {
    told_.punctual.assign(view.lights.begin(), view.lights.end());
    told_.skyRotation = view.skyRotation;
    live_.setLights(told_);
  }
  auto found = live_.take();
  if (!found) return false;
  irradiance_ = std::move(*found);
  return true;
}

void RadiosityFollower::show(Renderer& renderer) const { renderer.updateIrradiance(irradiance_); }

}  // namespace prelight::viewer
