#include "viewer/scene_follower.h"

namespace prelight::viewer {

bool SceneFollower::update(const View& view) {
  const bool moved = scene_.move(view.nodeShifts);
  if (moved) renderer_.sceneMoved();
  if (moved && objects_ != nullptr) renderer_.transferChanged(objects_->update(scene_.scene()));
  if (light_ == nullptr || view.shading != Shading::GlobalIllumination) return moved;
  const bool lit = light_->update({view.lights, scene_.shifts(), view.skyRotation});
  if (lit) {
    renderer_.updateIndirect(light_->indirect());
    renderer_.updateCaustics(light_->caustics());
  }
  return moved || lit;
}

bool SceneFollower::isBusy(const View& view) const {
  return light_ != nullptr && view.shading == Shading::GlobalIllumination && !light_->settled();
}

}  // namespace prelight::viewer
