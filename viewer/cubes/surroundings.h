#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "prelight/compiled_scene.h"
#include "viewer/core/camera.h"
#include "viewer/cubes/outside_place.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/surface_input.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// Cube maps of what lies around nodes that mirror or are glass: one per node, seen from the middle of the
/// node's bounds without the node itself (Larsen 2004, ch. 13). Beside the radiance every texel has its
/// distance, so that a ray from the surface, not from the middle, finds what it meets (Szirmay-Kalos et al.
/// 2005, "Approximate Ray-Tracing on the GPU with Distance Impostors"). A body of glass has another one, of
/// its own surface as seen from within, where rays leave it.
class Surroundings : public SurfaceInput {
 public:
  static constexpr int mostNodes = 16;  ///< those of the largest surface
  static constexpr int side = 128;      ///< texels of a face

  /// A face to be drawn: a camera, and the node that is left out.
  struct Face {
    Camera camera;
    int node = -1;
  };

  Surroundings(const RenderScene& scene, const CompiledScene& compiled);

  bool empty() const { return nodes_.empty(); }
  std::size_t nodeCount() const { return nodes_.size(); }
  std::size_t nodesLeftOut() const { return leftOut_; }
  std::size_t facesDrawn() const { return facesDrawn_; }  ///< by the last update

  /// Something shines in another way: all faces are drawn with the next update.
  void changed();

  /// Something has moved: all faces are drawn with the next update, from where the nodes are then.
  void moved();

  /// Light that changes slowly is another: an update draws one face, in turns.
  void changedSlowly();

  /// Draws faces that are out of date, at most so many, with `draw`, which is given a framebuffer of two by
  /// two samples a texel.
  void update(const CompiledScene& compiled, std::size_t mostFaces,
              const std::function<void(const Face&, const gl::Framebuffer&)>& draw);

  /// Some faces show what was there before.
  bool isBehind() const { return waiting_ > 0; }

  /// Binds the textures that cubes/surroundings.glsl reads.
  void bindTextures() const;

  void set(const gl::Program& program, const Batch& batch) const override;

 private:
  struct Node {
    int node = -1;
    bool glass = false;      ///< has an inside
    glm::vec3 center{0.0f};  ///< scene coordinates
    float radius = 0.0f;     ///< of its bounds
    float area = 0.0f;
    std::vector<std::size_t> batches;  ///< of the scene, whose batches are made anew where it moves
  };

  void findNodes(const CompiledScene& compiled);
  void place(const CompiledScene& compiled);
  std::vector<TwoSidedBody> twoSidedBodies(const CompiledScene& compiled) const;
  void drawFace(std::size_t face, const CompiledScene& compiled,
                const std::function<void(const Face&, const gl::Framebuffer&)>& draw);
  void drawInside(std::size_t place, const CompiledScene& compiled);

  const RenderScene& scene_;
  std::vector<Node> nodes_;
  std::size_t leftOut_ = 0;
  std::size_t facesDrawn_ = 0;
  std::size_t waiting_ = 0;  ///< faces that are out of date, from next_ on
  std::size_t next_ = 0;
  std::size_t facesSeen_ = 0;  ///< drawn at least once: before, a node shows the sky
  bool placed_ = false;        ///< centres are those of the scene
  bool insidesDrawn_ = false;  ///< for these centres
  std::unique_ptr<gl::Framebuffer> target_;
  std::unique_ptr<gl::Program> insideProgram_;
  gl::Object<gl::FramebufferTraits> copyTarget_;
  gl::Texture cubes_;    ///< [node] radiance, distance in m
  gl::Texture insides_;  ///< [node] normal, distance in m
};

}  // namespace prelight::viewer
