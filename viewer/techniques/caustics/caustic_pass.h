#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "photon/caustic_light.h"
#include "prelight/compiled_scene.h"
#include "viewer/core/camera.h"
#include "viewer/core/render_inputs.h"
#include "viewer/gl/buffer.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/techniques/caustics/caustic_levels.h"

namespace prelight::viewer {

/// Caustics filtered in the space of the picture (Larsen 2004, ch. 12, corrected): photons drawn as points
/// onto the surfaces seen, then a filter whose weights are areas of the surface and whose radius is a length
/// in the scene. Where that radius spans many pixels, the filter reads a coarser level, so that its cost has
/// a bound. Only cells of a level that hold photons, or whose neighbours do, are filtered.
class CausticPass {
 public:
  /// Texels of a level that the filter looks at on each side of a texel.
  static constexpr int margin = 8;
  /// A cell's side, texels of its level: no less than the filter's reach, so that its neighbours are all it looks into.
  static constexpr int cellSide = margin;

  CausticPass(const Caustics& caustics, const CompiledScene& scene);

  void update(const Caustics& caustics, const CompiledScene& scene);

  /// There are no photons: nothing to draw.
  bool empty() const { return positions_.empty(); }

  /// Returns how many levels a picture needs; `pixelWidth` as in surface_places.glsl.
  int levelsFor(const CameraMatrices& camera, double pixelWidth) const;

  /// The target into which surface_places.frag has to draw opaque surfaces, cleared to 0, before
  /// drawPhotons(). It is the same object while the size stays.
  const gl::Framebuffer& places(const LevelRaster& raster);

  /// Draws photons over what places() of the raster's level holds. The Frame block in use is of the raster.
  void drawPhotons(const LevelRaster& raster, double pixelWidth, const gl::Texture& triangleNormals);

  /// Filters photons over level 0. `rasters` are those of all levels, finest first, whose photons were drawn.
  /// The Frame block in use is of the same camera.
  void filter(std::span<const LevelRaster> rasters, double pixelWidth, const gl::Texture& triangleNormals);

  /// Irradiance, W/m2, of every pixel of level 0; alpha is 0 where nothing was filtered.
  const gl::Texture& irradiance() const { return irradiance_->color(); }

  /// A texel for each cell of level 0 from its lower left corner on, 1 where photons fall into it.
  const gl::Texture& marks() const { return levels_.front()->marks.color(); }

 private:
  /// Targets of one level.
  struct Targets {
    Targets(int width, int height);
    gl::Framebuffer places, power, marks;
  };

  void drawPoints(const gl::Program& program, const gl::Framebuffer& target, bool add) const;
  void setLevel(const gl::Program& program, const Targets& targets, double pixelWidth,
                const gl::Texture& triangleNormals) const;
  void filterLevel(const LevelRaster& raster, const LevelRaster& finest) const;

  CausticFilter filter_;
  bool skipCells_;
  std::vector<glm::vec3> positions_;  ///< of the photons, scene coordinates
  gl::Program photonProgram_, markProgram_, filterProgram_;
  gl::Buffer photons_;
  gl::VertexArray photonArray_, noVertices_;
  std::vector<std::unique_ptr<Targets>> levels_;
  std::unique_ptr<gl::Framebuffer> irradiance_;
};

}  // namespace prelight::viewer
