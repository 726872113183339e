#include "viewer/window/scene_follower.h"

#include <algorithm>

namespace prelight::viewer {

LightFollower* SceneFollower::followerOf(Shading shading) const {
  const auto found = std::find_if(lights_.begin(), lights_.end(),
                                  [&](const LightFollower* light) { return light->shading() == shading; });
  return found == lights_.end() ? nullptr : *found;
}

std::vector<DragNode> dragNodes(const PosedScene& scene) {
  std::vector<DragNode> nodes;
  for (const PosedScene::Node& node : scene.nodes()) nodes.push_back({node.name, node.center});
  return nodes;
}

bool SceneFollower::update(Controls& controls) {
  const View& view = controls.view();
  const PoseChange change = showPose(scene_, renderer_, {view.moment, view.nodeShifts}, view.shading);
  if (change.places) controls.follow({scene_.lights(), scene_.cameras()});
  if (change.places && objects_ != nullptr)
    renderer_.transferChanged(objects_->update(scene_.shown().compiled));
  LightFollower* light = followerOf(view.shading);
  if (light == nullptr) return change.any();
  const bool lit = light->update({view.lights, &scene_.shown().compiled, view.skyRotation, view.groupFactors,
                                  glm::dvec3(view.camera.world[3])});
  if (lit) light->show(renderer_);
  return change.any() || lit;
}

bool SceneFollower::isBusy(const View& view) const {
  const LightFollower* light = followerOf(view.shading);
  return light != nullptr && !light->settled();
}

}  // namespace prelight::viewer
