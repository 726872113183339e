#pragma once

#include <memory>
#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "viewer/core/occlusion_options.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/surface_input.h"
#include "viewer/programs/texture_units.h"
#include "viewer/scene/vertex_stream.h"
#include "viewer/techniques/screen/fields/field_shapes.h"

namespace prelight::viewer {

/// Fields of a scene's objects in OpenGL, as techniques/screen/fields/fields.glsl occludes by them, and what
/// techniques/screen/fields/screen_owner.frag needs to tell whose surface a pixel sees.
class FieldOcclusion : public SurfaceInput {
 public:
  /// The scene outlives it, and the device: nullptr: one is opened when fields are cast.
  FieldOcclusion(const CompiledScene& scene, const Device* device) : scene_(scene), device_(device) {}

  /// Vertices are at other places; there may be other triangles, too.
  void sceneMoved() { moved_ = true; }

  /// Bytes that a field takes in OpenGL.
  static std::size_t bytesOf(const OcclusionField& field);

  /// Makes the fields ready; `radius`: m, beyond which nothing occludes.
  void prepare(const ScreenOcclusionOptions& options, double radius);

  /// Binds them to a unit and the next.
  void attach(GLuint unit) const;

  /// Sets the uniforms of fields.glsl in the program in use.
  static void setUniforms(const gl::Program& program, GLuint unit);

  /// Binds what techniques/screen/fields/screen_owner.frag is drawn with.
  void bind(const gl::Program& program) const override;

 private:
  /// The options that fields are ready for.
  struct Ready {
    double radius = 0.0;
    int cells = 0, rays = 0;

    bool operator==(const Ready&) const = default;
  };

  const Device& device();
  void cast(const Ready& wanted);
  void uploadCells();
  void uploadPlaces();

  const CompiledScene& scene_;
  const Device* device_;
  std::optional<Device> opened_;
  std::unique_ptr<FieldShapes> shapes_;
  std::vector<glm::uvec3> triangles_;      ///< that they are of
  std::vector<std::uint32_t> firstCells_;  ///< [shape]
  std::optional<VertexStream> own_;
  gl::BufferTexture owners_, cells_, places_;
  Ready ready_;
  bool moved_ = false;
};

}  // namespace prelight::viewer
