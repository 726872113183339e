#pragma once

#include <future>
#include <optional>
#include <vector>

#include "integrators/global_illumination_renderer.h"
#include "pictures/drawing_session.h"
#include "pictures/picture_denoising.h"
#include "pictures/picture_request.h"
#include "pictures/picture_sky.h"
#include "prelight/device.h"
#include "prelight/picture.h"

namespace prelight::pictures {

/// Sky and camera that the pictures of one scene share.
struct PictureSetUp {
  PictureSky sky;
  std::optional<Camera> camera;  ///< for all pictures; none: the camera of each picture's scene
};

/// A picture of full shading that is to be traced. It refers to its scene and its PictureSetUp.
struct TracedPlan {
  GlobalIlluminationPictureRequest request;
  Camera camera;
  LitScene lit;
};

/// A picture of full shading that was traced.
struct TracedPicture {
  Picture picture;
  Camera camera;
  std::vector<Light> lights;
  GlobalIlluminationPictureRequest request;
  GlobalIlluminationPictureReport report;
};

/// Opens the device that the request names in another thread, while the scene is read.
std::shared_future<Device> openAside(DrawingSession& session, const PictureRequest& asked);

/// Reads the scene of a picture that uses no bake.
OpenedScene loadForPicture(DrawingSession& session, const PictureRequest& asked);

/// Poses a scene whose bake no picture uses.
void poseForPicture(DrawingSession& session, const PoseOptions& pose, OpenedScene& loaded);

/// Chooses the sky of a posed scene, which is prepared for the studio where that is its sky.
PictureSetUp setUpPicture(DrawingSession& session, const PictureRequest& asked, OpenedScene& loaded);

/// Lays out a picture: lamps with an area become surfaces of `loaded`, and a neutral sky lights a scene
/// without any light, which is said. `loaded` and `setUp` outlive the plan.
TracedPlan planTracedPicture(DrawingSession& session, const PictureRequest& asked, OpenedScene& loaded,
                             PictureSetUp& setUp);

/// Traces the picture with all light, denoised if that is wanted.
TracedPicture tracePicture(DrawingSession& session, const PictureRequest& asked, OpenedScene& loaded,
                           PictureSetUp& setUp, PictureDenoising& denoising,
                           const std::shared_future<Device>& opening);

}  // namespace prelight::pictures
