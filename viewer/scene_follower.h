#pragma once

#include "viewer/light_follower.h"
#include "viewer/moved_scene.h"
#include "viewer/object_follower.h"
#include "viewer/renderer.h"

namespace prelight::viewer {

/// What follows a view besides its picture: places of nodes, and light that is computed all the while.
class SceneFollower {
 public:
  /// Everything outlives it; `light` nullptr: it stays as it is; `objects` nullptr: there are none.
  SceneFollower(Renderer& renderer, MovedScene& scene, LightFollower* light, ObjectFollower* objects)
      : renderer_(renderer), scene_(scene), light_(light), objects_(objects) {}

  /// True when the picture is out of date for it.
  bool update(const View& view);

  /// Light of the view would change further by itself.
  bool isBusy(const View& view) const;

 private:
  Renderer& renderer_;
  MovedScene& scene_;
  LightFollower* light_;
  ObjectFollower* objects_;
};

}  // namespace prelight::viewer
