#pragma once

#include <utility>
#include <vector>

#include "viewer/follow/light_follower.h"
#include "viewer/follow/object_follower.h"
#include "viewer/follow/posed_scene.h"
#include "viewer/frame/renderer.h"
#include "viewer/window/controls.h"

namespace prelight::viewer {

/// Nodes of a scene that can be dragged, for Controls.
std::vector<DragNode> dragNodes(const PosedScene& scene);

/// Follows the user's input besides the picture: the pose of the scene, the bake of that pose, and light
/// that is computed all the while.
class SceneFollower {
 public:
  /// Everything outlives it. Light of shadings without a follower stays as it is; `objects` nullptr: there
  /// are none.
  SceneFollower(Renderer& renderer, PosedScene& scene, std::vector<LightFollower*> lights,
                ObjectFollower* objects = nullptr)
      : renderer_(renderer), scene_(scene), lights_(std::move(lights)), objects_(objects) {}

  /// Poses the scene as the view has it, and has the view's lights and camera follow. True when the picture
  /// is out of date for it.
  bool update(Controls& controls);

  /// Light of the view would change further by itself.
  bool isBusy(const View& view) const;

 private:
  LightFollower* followerOf(Shading shading) const;

  Renderer& renderer_;
  PosedScene& scene_;
  std::vector<LightFollower*> lights_;
  ObjectFollower* objects_;
};

}  // namespace prelight::viewer
