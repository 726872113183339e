#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "photon/caustic_light.h"
#include "prelight/compiled_scene.h"
#include "viewer/core/render_inputs.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"

namespace prelight::viewer {

/// Caustics filtered in the space of the picture (Larsen 2004, ch. 12, corrected): photons drawn as points
/// onto the surfaces seen, then a filter whose weights are areas of the surface. Only cells of the picture
/// that hold photons, or whose neighbours do, are filtered.
class CausticPass {
 public:
  /// Pixels around a picture that the filter of those at its border looks at.
  static constexpr int margin = 8;
  /// A cell's side, pixels: no less than the filter's reach, so that its neighbours are all it looks into.
  static constexpr int cellSide = margin;

  CausticPass(const Caustics& caustics, const CompiledScene& scene);

  void update(const Caustics& caustics, const CompiledScene& scene);

  /// There are no photons: nothing to draw.
  bool empty() const { return photonCount_ == 0; }

  /// The target into which surface_places.frag has to draw opaque surfaces, cleared to 0, before draw().
  /// It is the same object while the size stays.
  const gl::Framebuffer& places(int width, int height);

  /// Filters photons over what places() holds. The Frame block in use is of that picture; pixelWidth as in
  /// surface_places.glsl.
  void draw(double pixelWidth, const gl::Texture& triangleNormals);

  /// Irradiance, W/m2, of every pixel of places(); alpha is 0 where nothing was filtered.
  const gl::Texture& irradiance() const { return targets_->irradiance.color(); }

  /// A texel for each cell of places() from its lower left corner on, 1 where photons fall into it.
  const gl::Texture& marks() const { return targets_->marks.color(); }

 private:
  /// Targets of one size.
  struct Targets {
    Targets(int width, int height);
    gl::Framebuffer places, power, irradiance, marks;
  };

  void drawPhotons(const gl::Program& program, const gl::Framebuffer& target, bool add) const;
  void setPicture(const gl::Program& program, double pixelWidth, const gl::Texture& triangleNormals) const;

  CausticFilter filter_;
  bool skipCells_;
  GLsizei photonCount_ = 0;
  gl::Program photonProgram_, markProgram_, filterProgram_;
  gl::Buffer photons_;
  gl::VertexArray photonArray_, noVertices_;
  std::unique_ptr<Targets> targets_;
};

}  // namespace prelight::viewer
