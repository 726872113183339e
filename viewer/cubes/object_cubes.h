#pragma once

#include <array>
#include <cstddef>
#include <functional>
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
#include "viewer/programs/surface_input.h"
#include "viewer/scene/render_scene.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {

/// Light for objects that nothing was baked for: a small cube map each of the lit scene around the object,
/// without it, seen from the middle of its bounds; its projection to SH, which gives its diffuse light
/// ("Real-Time Rendering", 4th edition, 10.6.1: cubes drawn live to SH); and its distances, which tell what
/// stands between the object and lamps. What gives light by itself is not in the maps: lamps and samples of
/// emissive surfaces light the object as such, from where each point of it is.
class ObjectCubes : public SurfaceInput {
 public:
  static constexpr int side = 32;  ///< texels of a face
  static constexpr int order = 3;  ///< bands: what a cosine leaves of light beyond is an eighth of the last
  static constexpr double jump = 0.5;  ///< of an object's radius: moved so far, it gets all faces at once

  /// A face to be drawn: a camera, and the triangles that are left out.
  struct Face {
    Camera camera;
    VertexRange leftOut;
  };

  /// `compiled` holds the objects. `openness`: [vertex of theirs] as RenderInputs::cubeOpenness.
  ObjectCubes(const CompiledScene& compiled, std::span<const VertexRange> objects,
              std::span<const glm::vec3> openness);

  std::size_t count() const { return objects_.size(); }
  std::size_t facesDrawn() const { return facesDrawn_; }  ///< by the last update

  bool holds(const Batch& batch) const { return objectOf(batch) >= 0; }

  /// Something shines in another way: all faces are drawn with the next update.
  void changed();

  /// Light has changed little: updates draw so many faces each as they may, until all are new.
  void changedSlowly();

  /// Sets the light of the scene for the next update, and the shading that draws it.
  void lit(const Illumination& light, Shading shading);

  /// Something has moved. Objects that have moved far get all faces with the next update.
  void moved(const CompiledScene& compiled);

  /// Draws faces that are out of date with `draw`, which is given a framebuffer of two by two samples a
  /// texel, and projects their cubes. `mostFaces`: of what has changed little.
  void update(const CompiledScene& compiled, std::size_t mostFaces,
              const std::function<void(const Face&, const gl::Framebuffer&)>& draw);

  bool isBehind() const { return waiting_ > 0; }

  /// Binds the textures that cubes/object_light.glsl reads.
  void bindTextures() const;

  void bind(const gl::Program&) const override { openness_.attach(); }
  void set(const gl::Program& program, const Batch& batch) const override;

  const CubeProjection& projection() const { return projection_; }

 private:
  struct Object {
    VertexRange range;
    glm::vec3 center{0.0f};  ///< scene coordinates
    float radius = 0.0f;
    std::array<glm::vec3, facesOfACube> seenFrom = {};  ///< where each face was drawn
  };

  bool hasMovedFar(const Object& object) const;
  int objectOf(const Batch& batch) const;
  void place(const CompiledScene& compiled);

  std::vector<Object> objects_;
  float reach_ = 0.0f;  ///< diagonal of the scene's bounds
  gl::Framebuffer target_;
  gl::Object<gl::FramebufferTraits> copyTarget_;
  gl::Texture cubes_;  ///< [object] radiance, distance in m
  CubeProjection projection_;
  VertexStream openness_;
  std::optional<Illumination> light_;  ///< of the last update
  Shading shading_ = Shading::Phong;
  std::size_t facesDrawn_ = 0;
  std::size_t waiting_ = 0;  ///< faces that are out of date, from next_ on
  std::size_t next_ = 0;
  bool atOnce_ = false;  ///< all that are out of date are drawn with the next update
};

}  // namespace prelight::viewer
