#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "pictures/picture_request.h"
#include "pictures/session/drawing_session.h"
#include "pictures/shaded_scene.h"
#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/plan.h"

namespace prelight::pictures {

/// A picture and its further layers.
struct LayeredPicture {
  Picture picture = {};
  std::vector<PictureChannel> layers = {};
};

/// A picture that OpenGL drew, and what it was drawn from.
struct DrawnPicture {
  ShadedScene shaded;
  LayeredPicture layered;
  Warnings notes;  ///< what the picture approximates
  std::vector<PlannedPass> plan;
};

/// Returns the samples along each axis of a pixel with which OpenGL draws about `samples` in all.
int samplesPerAxis(std::uint32_t samples);

/// Draws a scene that is prepared. With `layers` the parts that sum up to the picture are made, too.
DrawnPicture drawPicture(DrawingSession& session, ShadedScene shaded, bool layers);

/// Warns of a picture that shows nothing, and of a denoiser that was asked for in vain.
void warnOfPicture(DrawingSession& session, const PictureRequest& asked, const DrawnPicture& drawn);

}  // namespace prelight::pictures
