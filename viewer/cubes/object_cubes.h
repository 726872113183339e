#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"
#include "viewer/core/camera.h"
#include "viewer/core/shading.h"
#include "viewer/cubes/cube_faces.h"
#include "viewer/cubes/cube_projection.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/lights/illumination.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/scene/render_scene.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// Light for objects that nothing was baked for: a small cube map each of the lit scene around the object,
/// without it, seen from the middle of its bounds; its projection to SH, which gives its diffuse light
/// ("Real-Time Rendering", 4th edition, 10.6.1: cubes drawn live to SH); and its distances, which tell what
/// stands between the object and lamps. What gives light by itself is not in the maps: lamps and samples of
/// emissive surfaces light the object as such, from where each point of it is.
class ObjectCubes final : public TechniquePass {
 public:
  static constexpr int side = 32;  ///< texels of a face
  static constexpr int order = 3;  ///< bands: what a cosine leaves of light beyond is an eighth of the last
  static constexpr double jump = 0.5;  ///< of an object's radius: moved so far, it gets all faces at once

  /// `compiled` holds the objects and outlives it. `openness`: [vertex of theirs] as
  /// RenderInputs::cubeOpenness.
  ObjectCubes(const CompiledScene& compiled, std::span<const VertexRange> objects,
              std::span<const glm::vec3> openness);

  void prepare(const PictureState& picture, SceneDrawer& drawer) override;
  void bindTextures() const override;  ///< that cubes/object_light.glsl reads
  bool hasOwnRules() const override { return true; }
  bool isOwn(const Batch& batch) const override { return objectOf(batch) >= 0; }

  /// As the scene's, but each point is lit from its own position.
  DrawingRules ownRules(const DrawingRules& rules) const override;
  bool isBehind() const override { return waiting_ > 0; }

  /// Objects that have moved far get all faces with the next picture.
  void sceneMoved() override;
  void takeLight(const FoundLight&) override { changedSlowly(); }
  void bind(const gl::Program&) const override { openness_.attach(); }
  void set(const gl::Program& program, const Batch& batch) const override;

  /// Whether pictures of a shading have them.
  static bool areIn(Shading shading, const RenderInputs& inputs) {
    return !inputs.cubeLit.empty() && infoOf(shading).traits.objectsInCubes;
  }

 private:
  struct Object {
    VertexRange range;
    glm::vec3 center{0.0f};  ///< scene coordinates
    float radius = 0.0f;
    std::array<glm::vec3, facesOfACube> seenFrom = {};  ///< where each face was drawn
  };

  bool hasMovedFar(const Object& object) const;
  int objectOf(const Batch& batch) const;
  void place();

  /// Something shines in another way: all faces are drawn with the next picture.
  void changed();

  /// Light has changed little: pictures draw so many faces each as they may, until all are new.
  void changedSlowly();
  void lit(const Illumination& light, Shading shading);
  std::size_t draw(std::size_t mostFaces, const PictureState& picture, SceneDrawer& drawer);

  const CompiledScene& compiled_;

  std::vector<Object> objects_;
  float reach_ = 0.0f;  ///< diagonal of the scene's bounds
  gl::Framebuffer target_;
  gl::Object<gl::FramebufferTraits> copyTarget_;
  gl::Texture cubes_;  ///< [object] radiance, distance in m
  CubeProjection projection_;
  VertexStream openness_;
  std::optional<Illumination> light_;  ///< of the last picture
  Shading shading_ = Shading::Phong;
  std::size_t waiting_ = 0;  ///< faces that are out of date, from next_ on
  std::size_t next_ = 0;
  bool atOnce_ = false;  ///< all that are out of date are drawn with the next picture
};

}  // namespace prelight::viewer
