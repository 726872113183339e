#pragma once

#include <utility>
#include <vector>

#include "viewer/light_follower.h"
#include "viewer/moved_scene.h"
#include "viewer/renderer.h"

namespace prelight::viewer {

/// What follows a view besides its picture: places of nodes, and light that is computed all the while.
class SceneFollower {
 public:
  /// Everything outlives it. Light of shadings without a follower stays as it is.
  SceneFollower(Renderer& renderer, MovedScene& scene, std::vector<LightFollower*> lights)
      : renderer_(renderer), scene_(scene), lights_(std::move(lights)) {}

  /// True when the picture is out of date for it.
  bool update(const View& view);

  /// Light of the view would change further by itself.
  bool isBusy(const View& view) const;

 private:
  LightFollower* followerOf(Shading shading) const;

  Renderer& renderer_;
  MovedScene& scene_;
  std::vector<LightFollower*> lights_;
};

}  // namespace prelight::viewer
