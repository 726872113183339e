#pragma once

#include "viewer/render.h"
#include "viewer/renderer.h"

namespace prelight::viewer {

/// The view that options ask for. Throws UsageError (camera index, size, samples, unknown light group).
View makeView(const RenderInputs& inputs, const RenderOptions& options);

/// Draws a view tile by tile, so that its size is not bound by what OpenGL draws at once. `layers` receives
/// what the picture is a sum of, and how open surfaces are where the shading knows; nullptr: not wanted.
Picture renderView(Renderer& renderer, const View& view, int samplesPerAxis,
                   std::vector<PictureChannel>* layers = nullptr);

}  // namespace prelight::viewer
