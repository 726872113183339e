#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gi/global_illumination.h"
#include "pictures/drawn_caustics.h"
#include "pictures/followed_light.h"
#include "pictures/picture_request.h"
#include "pictures/pose.h"
#include "pictures/session/drawing_session.h"
#include "pictures/volume_objects.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "viewer/follow/posed_scene.h"
#include "viewer/frame/render.h"

namespace prelight::pictures {

/// A scene that is ready to be drawn.
struct ShadedScene {
  LoadedScene loaded;
  Bake bake;           ///< the file's bake and what was baked for the shading
  BakedMotion motion;  ///< if the scene is posed
  std::optional<Environment> environment;
  bool studio = false;  ///< `environment` is the built-in studio
  viewer::RenderOptions render;
  std::optional<BakeRun> run;            ///< if something was baked
  BakeRequest request;                   ///< the request of `run`
  std::shared_ptr<const Device> device;  ///< relights what shaders do not
  std::unique_ptr<DrawnCaustics> caustics;
  std::optional<GlobalIllumination> globalIllumination;
  const Encoding* encoding = nullptr;  ///< the encoding that is drawn
  /// Objects and probes, which are in `loaded` and `bake`, too
  std::unique_ptr<VolumeObjects> objects;
  std::unique_ptr<FollowingLight> following;              ///< for a window with global illumination
  std::unique_ptr<FollowingVirtualLights> virtualLights;  ///< for instant shading

  /// Returns what was computed for the picture and what was left out.
  std::vector<PlannedPass> plan() const;
  /// Returns whether lamps cast shadows of the objects around them.
  bool shadowsLamps() const { return globalIllumination.has_value(); }

  viewer::RenderInputs inputs() const;
  /// Returns what other poses need; it refers to both objects.
  viewer::PoseSources poseSources(const PoseOptions& pose) const;
};

/// Loads the scene, checks the options against it and bakes what the shading needs and the file does not
/// hold, with a note. `checkOutputs` runs after the input was read and before anything is baked. With
/// `everyShading` the bake includes what ao, sh and the other options need, so that shadings can be switched.
ShadedScene prepareScene(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                         const std::function<void()>& checkOutputs);

/// Prepares a scene that is loaded, with the bake that it is drawn from.
ShadedScene prepareScene(DrawingSession& session, const PictureRequest& asked, LoadedScene loaded, Bake bake,
                         bool everyShading, const std::function<void()>& checkOutputs);

/// Reads a file's bake; returns an empty one if there is none.
Bake carriedBake(DrawingSession& session, const LoadedScene& loaded);

}  // namespace prelight::pictures
