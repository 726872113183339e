#pragma once

#include <memory>
#include <span>
#include <vector>

#include "prelight/plan.h"
#include "viewer/core/picture_slices.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/sliced_work.h"
#include "viewer/core/uniform_blocks.h"
#include "viewer/core/view_state.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/lights/illumination.h"
#include "viewer/programs/batch_drawer.h"
#include "viewer/programs/draw_order.h"
#include "viewer/programs/frame_pass.h"
#include "viewer/programs/surface_input.h"

namespace prelight::viewer {

class DrawnTransfer;

/// How pictures that follow one another share work.
struct PicturePace {
  bool spread = false;  ///< many shadow maps and environment maps are redrawn over several pictures
  bool joined = false;  ///< occlusion that is the mean of several pictures takes those drawn before
  double slice =
      PictureSlices::unbounded;  ///< s that a slice of the picture may take; SlicedWork pauses then
};

/// A picture that is about to be drawn, or one of the cube map faces that it needs.
struct PictureState {
  const View& view;
  const Illumination& light;
  const DrawnTransfer* transfer = nullptr;
  PicturePace pace = {};
  FramePassObserver passed;  ///< is told of every part that has been drawn
};

/// A tile of a picture, whose surfaces are about to be drawn.
struct TileState {
  const PictureState& picture;
  const Tile& tile;
  const gl::Framebuffer& target;
  const std::vector<const Batch*>& opaque;
  std::span<const ShadedLight> lights;  ///< that shaders look at
};

/// How the surfaces of a tile are drawn.
struct TileLook {
  BatchLook opaque, blended;
};

/// A face of a cube map.
struct SceneFace {
  Camera camera;
  int side = 0;  ///< pixels
  LeftOut leftOut = {};
  bool withoutEmission = false;  ///< what gives light is not seen
};

/// The scene as passes draw it.
class SceneDrawer {
 public:
  virtual ~SceneDrawer() = default;

  /// Draws the scene of a picture as a face of a cube map shows it.
  virtual void drawFace(const PictureState& picture, const SceneFace& face,
                        const gl::Framebuffer& target) = 0;

  /// Puts the uniform blocks of a tile in use. `turns`: side in pixels of the square that shares samples of
  /// lights.
  virtual FrameBlock useFrame(const View& view, const Tile& tile, std::span<const ShadedLight> lights,
                              int turns) const = 0;

  /// Binds the textures of the scene that programs of surfaces read.
  virtual void bindTextures(const View& view) const = 0;
};

/// A pass in which a technique draws something that surfaces read. It is made when a picture first has it,
/// and stays. A picture calls its functions in their order here.
class TechniquePass : public SurfaceInput {
 public:
  /// Gives lights the shadows that it knows, and makes these ready.
  virtual void shadow(std::vector<ShadedLight>& /*lights*/) {}

  /// Gives samples of lights that stand for those of shadow() the same shadows.
  virtual void shadowSamples(std::span<const ShadedLight> /*lights*/,
                             std::span<ShadedLight> /*samples*/) const {}

  /// Draws what all tiles of a picture read, under its light.
  virtual void prepare(const PictureState&, SceneDrawer&) {}

  /// Adds the features of programs that read it.
  virtual void addFeatures(Features&) const {}

  /// Draws what the surfaces of a tile read, and says how they are drawn then. Between two slices others may
  /// draw, but not a picture.
  virtual SlicedWork drawTile(TileState, SceneDrawer&, TileLook&) { co_return; }

  /// Binds the textures that stay bound while surfaces are drawn.
  virtual void bindTextures() const {}

  /// True: some batches are drawn by rules of its own, whose shaders look at all lights.
  virtual bool hasOwnRules() const { return false; }
  virtual bool isOwn(const Batch&) const { return false; }
  virtual DrawingRules ownRules(const DrawingRules& rules) const { return rules; }

  /// Further pictures of the same view would show more of what has moved.
  virtual bool isBehind() const { return false; }

  /// The scene's vertices are at other places.
  virtual void sceneMoved() {}

  /// Pictures are drawn from another bake of the same scene.
  virtual void takeBake(const Bake&) {}

  /// Light of the scene has been found anew, or has changed a little.
  virtual void takeLight(const FoundLight&) {}

  /// Adds what it draws for the last picture besides it, and what it leaves out.
  virtual void addPlan(std::vector<PlannedPass>&) const {}

  /// Adds notes on what pictures leave out.
  virtual void describe(Warnings&) const {}
};

/// The inputs of what techniques draw; all outlive it.
struct TechniqueInputs {
  const RenderInputs& inputs;
  const RenderScene& scene;
  BatchDrawer& batches;
  Lobe lobe = Lobe::Ggx;
};

/// The row of a pass in the registry of techniques.
struct PassRow {
  /// Whether pictures of a shading have it.
  bool (*isIn)(Shading shading, const RenderInputs& inputs);
  std::unique_ptr<TechniquePass> (*make)(const TechniqueInputs& inputs);
  /// Adds notes on what it could add to a picture of a shading that lacks it; nullptr: none.
  void (*describeLack)(Shading shading, const Illumination& light, Warnings& notes) = nullptr;
};

}  // namespace prelight::viewer
