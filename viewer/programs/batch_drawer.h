#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/core/layer_factors.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/programs/surface_input.h"
#include "viewer/programs/surface_programs.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// Sets the state of OpenGL in which opaque surfaces are drawn.
void useSurfaceState();

/// How batches are drawn.
struct BatchLook {
  const char* shader = "";                  ///< of fragments
  ShaderVariant variant;                    ///< without the features of surfaces
  std::vector<const SurfaceInput*> inputs;  ///< in the order in which they are bound
  Features ofSurfaces = Features::all();    ///< that the shader is to know
  glm::ivec4 causticCorner{0};              ///< of surface.frag
  int layer = 0;             ///< of screen_surface.frag; those behind the first have backs, too
  bool depthsFirst = false;  ///< nothing hidden is shaded
  bool sharesPrograms = false;  ///< by sharedFeatures(); the shader asks materials, too, what they have
  const ShownTriangles* shown = nullptr;  ///< those that are drawn; nullptr: all
  LayerFactors factors = wholePicture;    ///< of the picture's layers, where the variant shows parts
};

/// Draws the surfaces of a scene with the programs that they need.
class BatchDrawer {
 public:
  /// The scene outlives it.
  BatchDrawer(const RenderScene& scene, const Encoding* encoding);

  /// Tells that materials of the scene have changed.
  void materialsChanged();

  bool anySurfaceHas(Feature feature) const;

  void draw(const std::vector<const Batch*>& batches, const BatchLook& look);

  /// Draws into a target, which is cleared to 0 first.
  void drawInto(const gl::Framebuffer& target, const std::vector<const Batch*>& batches,
                const BatchLook& look);

  /// Draws the depths of surfaces without holes, so that nothing hidden is shaded.
  void drawDepths(const std::vector<const Batch*>& batches, const ShownTriangles& shown);

  /// Draws the sky behind opaque surfaces, unless it is the colour that the picture was cleared to.
  void drawBackground(const ShaderVariant& variant, float factor);

 private:
  const RenderScene& scene_;
  SurfacePrograms programs_;
  std::vector<Features> surfaceFeatures_;  ///< [surface]
  std::vector<Features> sharedFeatures_;   ///< [surface], with those of others that are drawn alike
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
