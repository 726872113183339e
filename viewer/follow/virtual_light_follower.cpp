#include "viewer/follow/virtual_light_follower.h"

#include "viewer/follow/view_changes.h"
#include "viewer/frame/renderer.h"

namespace prelight::viewer {

bool VirtualLightFollower::update(const FollowedView& view) {
  tellChanges(view, live_);
  Progress quiet;
  return live_.advance(quiet);
}

void VirtualLightFollower::show(Renderer& renderer) const {
  renderer.update(shading(), {.virtualLights = &live_.lights()});
}

}  // namespace prelight::viewer
