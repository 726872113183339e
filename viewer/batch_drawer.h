#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/drawn_transfer.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/near_lamp_pass.h"
#include "viewer/object_cubes.h"
#include "viewer/render_scene.h"
#include "viewer/surface_programs.h"
#include "viewer/surroundings.h"

namespace prelight::viewer {

/// How batches are drawn.
struct BatchLook {
  const char* shader = "";  ///< of fragments
  ShaderVariant variant;    ///< without the features of surfaces
  const DrawnTransfer* transfer = nullptr;
  const NearLampPass* nearLamps = nullptr;     ///< whose shadows vertices have
  const Surroundings* surroundings = nullptr;  ///< that mirrors and glass show
  const ObjectCubes* cubes = nullptr;          ///< that light objects
  bool withoutEmission = false;                ///< what gives light is not seen
  glm::ivec4 causticCorner{0};                 ///< of surface.frag
  int layer = 0;             ///< of screen_surface.frag; those behind the first have backs, too
  bool depthsFirst = false;  ///< nothing hidden is shaded
  int shownLayer = 0;        ///< of the picture, where the variant shows parts
};

/// Draws the surfaces of a scene with the programs that they need.
class BatchDrawer {
 public:
  /// The scene outlives it.
  BatchDrawer(const RenderScene& scene, const Encoding* encoding);

  /// The scene's surfaces are made of something else.
  void materialsChanged();

  bool anySurfaceHas(Feature feature) const;

  void draw(const std::vector<const Batch*>& batches, const BatchLook& look);

  /// Into a target, which is cleared to 0.
  void drawInto(const gl::Framebuffer& target, const std::vector<const Batch*>& batches,
                const BatchLook& look);

  /// So that what is hidden is not shaded: of surfaces without holes.
  void drawDepths(const std::vector<const Batch*>& batches);

  /// The sky behind what is opaque, where it is not what the picture was cleared to.
  void drawBackground(const ShaderVariant& variant);

 private:
  const RenderScene& scene_;
  SurfacePrograms programs_;
  std::vector<Features> surfaceFeatures_;  ///< [surface]
  gl::VertexArray noVertices_;
};

}  // namespace prelight::viewer
