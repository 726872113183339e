#pragma once

#include "viewer/frame/render.h"
#include "viewer/frame/renderer.h"

namespace prelight::viewer {

/// The view that options ask for. Throws UsageError (camera index, size, samples, unknown light group).
View makeView(const RenderInputs& inputs, const RenderOptions& options);

/// Reads a supersampled tile back and puts its box-filtered pixels into a picture.
void resolve(const gl::Framebuffer& samples, int samplesPerAxis, const Tile& tile, Picture& picture);

/// Draws a view tile by tile, so that its size is not bound by what OpenGL draws at once. `layers` receives
/// what the picture is a sum of, and how open surfaces are where the shading knows; nullptr: not wanted.
Picture renderView(Renderer& renderer, const View& view, int samplesPerAxis,
                   std::vector<PictureChannel>* layers = nullptr);

}  // namespace prelight::viewer
