#include "viewer/scene_follower.h"

namespace prelight::viewer {

std::vector<DragNode> dragNodes(const PosedScene& scene) {
  std::vector<DragNode> nodes;
  for (const PosedScene::Node& node : scene.nodes()) nodes.push_back({node.name, node.center});
  return nodes;
}

PoseChange showPose(PosedScene& scene, Renderer& renderer, const ScenePlace& place, Shading shading) {
  const PoseChange change = scene.pose(place, shading);
  if (change.materials) renderer.materialsChanged();
  if (change.places) renderer.sceneMoved(change.shapes);
  if (change.bake) renderer.bakeChanged(shading);
  return change;
}

bool SceneFollower::update(Controls& controls) {
  const View& view = controls.view();
  const PoseChange change = showPose(scene_, renderer_, {view.moment, view.nodeShifts}, view.shading);
  if (change.places) controls.follow({scene_.lights(), scene_.cameras()});
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
