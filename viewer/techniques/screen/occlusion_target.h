#pragma once

#include <optional>
#include <span>
#include <string>

#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"

namespace prelight::viewer {

/// Texture units of passes of screen-space occlusion; surfaces keep theirs, but for the first.
enum OcclusionUnit : GLuint {
  firstLayerUnit = 0,
  secondLayerUnit = 1,
  sentUnit = 2,
  foundUnit = 40,  ///< and those after it, one for each output
  pastUnit = 44,   ///< the same, and the past's surface
  scratchUnit = 48
};

/// The target, made anew where it is not of that size.
const gl::Framebuffer& fitted(std::optional<gl::Framebuffer>& target, int width, int height, int colors = 1);

/// Draws one triangle over all of the target with the program in use.
void drawOver(const gl::Framebuffer& target, const gl::VertexArray& noVertices);

/// Binds `count` colours of a framebuffer to units from `first` on.
void bindColors(const gl::Framebuffer& from, int count, GLuint first);

/// Tells the program in use that elements of a sampler array are at units from `first` on.
void setSamplers(const gl::Program& program, const std::string& name, int count, GLuint first);

}  // namespace prelight::viewer
