#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/camera.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/lighting.h"
#include "viewer/render_scene.h"

namespace prelight::viewer {

/// A rectangle of a picture, in pixels from its top left corner.
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// What may change from one picture of a scene to the next; nothing is uploaded for it but uniforms.
struct View {
  Camera camera;
  int width = 0;  ///< pixels of the whole picture
  int height = 0;
  Shading shading = Shading::Phong;
  double skyRotation = 0.0;  ///< radians about +Y
  std::vector<Light> lights;
  bool emitters = true;
  bool windowLights = true;
};

/// Draws a scene with the current OpenGL context; headless pictures and the window share it.
class Renderer {
 public:
  /// Uploads the scene. Throws Error when OpenGL cannot hold it.
  explicit Renderer(const RenderInputs& inputs);

  /// True when the bake carries what a shading needs.
  bool canShade(Shading shading) const;

  /// Draws the tile of the view into the whole of `target`, whose size is a multiple of the tile's.
  /// Throws Error for a shading that the bake does not carry.
  void draw(const View& view, const Tile& tile, const gl::Framebuffer& target) const;

  /// What a view approximates or had to choose, for people.
  void describe(const View& view, Warnings& notes) const;

 private:
  bool usesNeutralSky(const View& view) const;
  std::vector<ShadedLight> lightsOf(const View& view) const;
  void uploadFrame(const View& view, const Tile& tile, const std::vector<ShadedLight>& lights) const;
  void drawBatches(const std::vector<const Batch*>& batches) const;
  void bindTextures(const View& view) const;
  void setSurface(const Surface& surface) const;

  const CompiledScene& compiled_;
  RenderScene scene_;
  std::vector<ShadedLight> emitters_;
  SkyCoefficients sky_;
  SkyCoefficients neutralSky_;
  bool hasEnvironment_ = false;
  int skyWidth_ = 1;
  gl::Program surfaceProgram_;
  gl::Program backgroundProgram_;
  gl::Texture skyMap_;
  gl::Texture neutralSkyMap_;
  gl::Texture blackSkyMap_;
  gl::Buffer frameBlock_;
  gl::Buffer lightBlock_;
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
