#include "viewer/scene_follower.h"

#include <algorithm>

namespace prelight::viewer {

LightFollower* SceneFollower::followerOf(Shading shading) const {
  const auto found = std::find_if(lights_.begin(), lights_.end(),
                                  [&](const LightFollower* light) { return light->shading() == shading; });
  return found == lights_.end() ? nullptr : *found;
}

bool SceneFollower::update(const View& view) {
  const bool moved = scene_.move(view.nodeShifts);
  if (moved) renderer_.sceneMoved();
  LightFollower* light = followerOf(view.shading);
  if (light == nullptr) return moved;
  const bool lit = light->update({view.lights, scene_.shifts(), view.skyRotation});
  if (lit) light->show(renderer_);
  return moved || lit;
}

bool SceneFollower::isBusy(const View& view) const {
  const LightFollower* light = followerOf(view.shading);
  return light != nullptr && !light->settled();
}

}  // namespace prelight::viewer
