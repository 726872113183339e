#pragma once

#include <vector>

#include "prelight/error.h"
#include "prelight/picture.h"
#include "prelight/plan.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/render_options.h"

namespace prelight::viewer {

/// Draws a picture of linear radiance, without a display or a window.
/// `notes` receives, once each, what the picture approximates or what was chosen for want of an input.
/// Throws UsageError (camera index, size), Error (no OpenGL, shading that the bake does not carry).
/// `plan` receives what is drawn beside the picture and what is left out, `layers` what
/// the picture is a sum of and how open surfaces are where the shading knows; nullptr: not wanted.
Picture renderPicture(const RenderInputs& inputs, const RenderOptions& options, Warnings& notes,
                      std::vector<PlannedPass>* plan = nullptr,
                      std::vector<PictureChannel>* layers = nullptr);

}  // namespace prelight::viewer
