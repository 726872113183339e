#pragma once

#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "integrators/global_illumination_renderer.h"
#include "pictures/drawn_picture.h"
#include "pictures/picture_denoising.h"
#include "pictures/picture_request.h"
#include "pictures/picture_sky.h"
#include "pictures/session/drawing_session.h"
#include "prelight/device.h"
#include "prelight/picture.h"

namespace prelight::pictures {

using FullRequest = GlobalIlluminationPictureRequest;

/// Returns the request of full shading that options ask for, and the options of such a request.
FullRequest fullRequest(const FullOptions& options);
FullOptions fullOptions(const FullRequest& request);

/// Returns whether full shading is asked for.
inline bool asksForFull(const PictureRequest& asked) {
  return asked.shading == viewer::Shading::GlobalIllumination;
}

/// Data that the pictures of one scene share.
struct PictureSetUp {
  PictureSky sky;
};

/// A picture of full shading that is to be traced. It refers to its scene and its PictureSetUp.
struct TracedPlan {
  GlobalIlluminationPictureRequest request;
  Camera camera;
  LitScene lit;
};

/// A picture of full shading that was traced.
struct TracedPicture {
  LayeredPicture layered;
  Camera camera;
  std::vector<Light> lights;
  GlobalIlluminationPictureRequest request;
  GlobalIlluminationPictureReport report;
};

/// Opens the device that the request names in another thread, while the scene is read.
std::shared_future<std::shared_ptr<const Device>> openAside(DrawingSession& session,
                                                            const PictureRequest& asked);

/// Reads the scene of a picture that uses no bake.
LoadedScene loadForPicture(DrawingSession& session, const PictureRequest& asked);

/// Poses a scene whose bake no picture uses.
void poseForPicture(DrawingSession& session, const PoseOptions& pose, LoadedScene& loaded);

/// Chooses the sky of a posed scene, which gets a camera if it has none (frameScene()).
PictureSetUp setUpPicture(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded);

/// Lays out a picture: lamps with an area become surfaces of `loaded`, and a neutral sky lights a scene
/// without any light, which is said. `loaded` and `setUp` outlive the plan.
TracedPlan planTracedPicture(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded,
                             PictureSetUp& setUp);

/// Traces the picture with all light, denoised if that is wanted.
TracedPicture tracePicture(DrawingSession& session, const PictureRequest& asked, LoadedScene& loaded,
                           PictureSetUp& setUp, PictureDenoising& denoising,
                           const std::shared_future<std::shared_ptr<const Device>>& opening);

}  // namespace prelight::pictures
