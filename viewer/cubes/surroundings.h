#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"
#include "viewer/core/camera.h"
#include "viewer/cubes/cube_faces.h"
#include "viewer/cubes/lobe_cubes.h"
#include "viewer/cubes/outside_place.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {

/// How cube maps of surroundings are read.
enum class Reflecting : std::uint8_t {
  Mirrors,  ///< mirrors, metals and glass, in shadings of all light: the map itself, and mip levels for rough
            ///< ones
  Lobes     ///< what Surface::reflectsAround says, in shadings of a bake: lobes (LobeCubes), with the sky in
            ///< what is open of them
};

/// Cube maps of what lies around nodes that reflect or are glass: one per node, seen from the middle of the
/// node's bounds without the node itself (Larsen 2004, ch. 13), in the light and the shading of the picture.
/// Beside the radiance every texel has its distance, so that a ray from the surface, not from the middle,
/// finds what it meets (Szirmay-Kalos et al. 2005, "Approximate Ray-Tracing on the GPU with Distance
/// Impostors"). Among mirrors, a body of glass has another one, of its own surface as seen from within, where
/// rays leave it. Smaller nodes borrow the map that lies nearest, in which they are not seen.
class Surroundings final : public TechniquePass {
 public:
  static constexpr int mostNodes = 16;  ///< those of the largest surface
  /// Nodes with lobes, of the largest surface, that are asked what lies around them.
  static constexpr int mostTried = 64;
  static constexpr int side = 128;        ///< texels of a face
  static constexpr int sideOfRough = 64;  ///< the same where all lobes are wide
  /// Share of the directions that others fill about a node with lobes.
  static constexpr double leastAround = 0.1;

  /// Both outlive it.
  Surroundings(const RenderScene& scene, const CompiledScene& compiled, Reflecting reflecting);

  void prepare(const PictureState& picture, SceneDrawer& drawer) override;
  void addFeatures(Features& features) const override;
  void bindTextures() const override;  ///< that cubes/surroundings.glsl and cubes/local_reflections.glsl read
  bool isBehind() const override { return waiting_ > 0; }

  /// All faces are drawn with the next picture, from where the nodes are then; with lobes, of those that
  /// reflect then.
  void sceneMoved() override;

  /// The next picture draws one face, in turns; all faces are drawn where they have lobes.
  void takeLight(const FoundLight&) override;
  void addPlan(std::vector<PlannedPass>& plan) const override;
  void describe(Warnings& notes) const override;
  void set(const gl::Program& program, const Batch& batch) const override;

 private:
  struct Node {
    int node = -1;
    bool glass = false;       ///< has an inside that is shown
    bool seesItself = false;  ///< from its middle, as a room does: its cube map shows it
    bool narrow = false;      ///< has lobes that the smaller maps are too coarse for
    glm::vec3 center{0.0f};   ///< scene coordinates
    float radius = 0.0f;      ///< of its bounds
    float area = 0.0f;
    std::vector<std::size_t> batches;  ///< of the scene, whose batches are made anew where it moves
  };

  int nodeOf(const Batch& batch) const {
    return reflecting_ == Reflecting::Mirrors ? batch.node : batch.reflectingNode;
  }
  void chooseNodes();
  void makeMaps();
  void findNodes();
  void keepLargest(std::size_t most);
  void findCenter(Node& node) const;
  const Node* nodeWith(const Batch& batch) const;
  void leaveOutAlone();
  bool hasSurroundings(const Node& node) const;
  void place();
  std::vector<TwoSidedBody> twoSidedBodies() const;
  std::size_t facesOf(std::size_t rounds) const;
  void changed();
  std::size_t draw(std::size_t mostFaces, const PictureState& picture, SceneDrawer& drawer);
  void blur() const;
  std::size_t facesOfARound() const { return facesOfACube * nodes_.size(); }
  void drawFace(std::size_t face, const gl::Framebuffer& target, const PictureState& picture,
                SceneDrawer& drawer);
  void drawInside(std::size_t place);
  const Node* mapFor(const Node& node) const;

  const RenderScene& scene_;
  const CompiledScene& compiled_;
  Reflecting reflecting_;
  std::optional<Illumination> light_;        ///< that faces were drawn in
  const DrawnTransfer* transfer_ = nullptr;  ///< the shadows that they were drawn with
  bool coarse_ = false;                      ///< those were of a draft
  std::vector<Node> nodes_;
  std::vector<Node> borrowing_;  ///< mirrors and glass without a map
  std::size_t leftOut_ = 0;
  std::size_t alone_ = 0;  ///< nodes about which too little lies
  int side_ = side;
  std::size_t waiting_ = 0;  ///< faces that are out of date, from next_ on
  std::size_t next_ = 0;
  std::size_t facesSeen_ = 0;  ///< drawn at least once: before, a node has no map
  bool placed_ = false;        ///< centres are those of the scene
  bool insidesDrawn_ = false;  ///< for these centres
  std::unique_ptr<gl::Framebuffer> target_;
  std::unique_ptr<gl::Framebuffer> quickTarget_;  ///< of faces that are seen in other maps alone
  std::unique_ptr<gl::Program> insideProgram_;
  gl::Object<gl::FramebufferTraits> copyTarget_;
  gl::Texture cubes_;               ///< [node] radiance, distance in m
  gl::Texture insides_;             ///< [node] normal, distance in m
  std::optional<LobeCubes> lobes_;  ///< [node], of Reflecting::Lobes
};

}  // namespace prelight::viewer
