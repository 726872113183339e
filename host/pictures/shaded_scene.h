#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "gi/global_illumination.h"
#include "pictures/drawing_session.h"
#include "pictures/drawn_caustics.h"
#include "pictures/followed_light.h"
#include "pictures/picture_request.h"
#include "pictures/pose.h"
#include "pictures/volume_objects.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "viewer/posed_scene.h"
#include "viewer/render.h"

namespace prelight::pictures {

/// A scene ready to be drawn.
struct ShadedScene {
  OpenedScene loaded;
  Bake bake;           ///< what the file carries and what was baked for the shading
  BakedMotion motion;  ///< of a scene that is posed
  std::optional<Environment> environment;
  bool studio = false;  ///< `environment` is the built-in studio
  viewer::RenderOptions render;
  std::optional<BakeRun> run;    ///< when something was baked
  BakeRequest request;           ///< of `run`
  std::optional<Device> device;  ///< relights what a shader does not
  std::unique_ptr<DrawnCaustics> caustics;
  std::optional<GlobalIllumination> globalIllumination;
  const Encoding* encoding = nullptr;                     ///< that is drawn
  std::unique_ptr<VolumeObjects> objects;                 ///< and probes, in `loaded` and `bake`
  std::unique_ptr<FollowingLight> following;              ///< of a window that shows global illumination
  std::unique_ptr<FollowingVirtualLights> virtualLights;  ///< of instant shading

  viewer::RenderInputs inputs() const;
  /// What other poses need; refers to both.
  viewer::PoseSources poseSources(const PoseOptions& pose) const;
};

/// Loads, checks the options against the scene and bakes what the shading needs and the file does not carry,
/// saying so. `checkOutputs` runs after the input was read and before anything is baked. With `everyShading`
/// a bake also makes what ao and sh need and what else the options name, so that shadings can be switched.
ShadedScene prepareScene(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                         const std::function<void()>& checkOutputs);

/// Reads the bake that a file carries; an empty one when it carries none.
Bake carriedBake(DrawingSession& session, const OpenedScene& loaded);

}  // namespace prelight::pictures
