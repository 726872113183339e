#include "viewer/follow/radiosity_follower.h"

#include <algorithm>
#include <utility>

#include "viewer/frame/renderer.h"

namespace prelight::viewer {

RadiosityFollower::RadiosityFollower(LiveRadiosity& live, RadiosityLights shown,
                                     std::optional<RadiosityGroups> groups)
    : live_(live),
      told_(std::move(shown)),
      groups_(std::move(groups)),
      factors_(groups_ ? groups_->groups().size() : 1, glm::vec3(1.0f)) {}

bool RadiosityFollower::differs(const FollowedView& view) const {
  return view.skyRotation != told_.skyRotation ||
         !std::equal(view.lights.begin(), view.lights.end(), told_.punctual.begin(), told_.punctual.end(),
                     shinesAs);
}

/// True: they are others.
bool RadiosityFollower::takeFactors(const FollowedView& view) {
  if (!groups_ || view.groupFactors.size() != factors_.size() ||
      std::equal(factors_.begin(), factors_.end(), view.groupFactors.begin()))
    return false;
  factors_.assign(view.groupFactors.begin(), view.groupFactors.end());
  return true;
}

void RadiosityFollower::tell() {
  if (groups_)
    live_.setGroups(groups_->deal(told_));
  else
    live_.setLights(told_);
}

bool RadiosityFollower::update(const FollowedView& view) {
  const bool dimmed = takeFactors(view);
  if (differs(view)) {
    told_.punctual.assign(view.lights.begin(), view.lights.end());
    told_.skyRotation = view.skyRotation;
    tell();
  } else if (dimmed && lights_.empty()) {
    tell();  // what was baked does not tell groups apart
  }
  auto found = live_.takeGroups();
  if (found) lights_ = std::move(*found);
  if (lights_.empty() || !(found || dimmed)) return false;
  irradiance_ = irradianceOf(lights_, factors_);
  return true;
}

void RadiosityFollower::show(Renderer& renderer) const {
  renderer.update(shading(), {.irradiance = irradiance_});
}

}  // namespace prelight::viewer
