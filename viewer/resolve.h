#pragma once

#include "prelight/picture.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/renderer.h"

namespace prelight::viewer {

/// Reads a supersampled tile back and puts its box-filtered pixels into a picture.
void resolve(const gl::Framebuffer& samples, int samplesPerAxis, const Tile& tile, Picture& picture);

}  // namespace prelight::viewer
