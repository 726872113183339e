#include "viewer/scene_follower.h"

namespace prelight::viewer {

std::vector<DragNode> dragNodes(const PosedScene& scene) {
  std::vector<DragNode> nodes;
  for (const PosedScene::Node& node : scene.nodes()) nodes.push_back({node.name, node.center});
  return nodes;
}

bool SceneFollower::update(Controls& controls) {
  const View& view = controls.view();
  const PoseChange change = scene_.pose({view.moment, view.nodeShifts}, view.shading);
  if (change.places) {
    renderer_.sceneMoved(change.shapes);
    controls.follow({scene_.lights(), scene_.cameras()});
  }
  if (change.bake) renderer_.bakeChanged(view.shading);
  if (light_ == nullptr || view.shading != Shading::GlobalIllumination) return change.any();
  const bool lit = light_->update({view.lights, scene_.shifts(), view.skyRotation});
  if (lit) {
    renderer_.updateIndirect(light_->indirect());
    renderer_.updateCaustics(light_->caustics());
  }
  return change.any() || lit;
}

bool SceneFollower::isBusy(const View& view) const {
  return light_ != nullptr && view.shading == Shading::GlobalIllumination && !light_->settled();
}

}  // namespace prelight::viewer
