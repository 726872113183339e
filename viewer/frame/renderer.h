#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "relight/vertex_lights.h"
#include "viewer/core/camera.h"
#include "viewer/core/render_inputs.h"
#include "viewer/core/view_state.h"
#include "viewer/debug/debug_views.h"
#include "viewer/frame/picture_layers.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/texture.h"
#include "viewer/lights/drawn_sky.h"
#include "viewer/lights/illumination.h"
#include "viewer/lights/view_lights.h"
#include "viewer/programs/batch_drawer.h"
#include "viewer/programs/draw_order.h"
#include "viewer/programs/frame_pass.h"
#include "viewer/scene/render_scene.h"
#include "viewer/techniques/registry/techniques.h"

namespace prelight::viewer {

/// Draws a scene with the current OpenGL context; headless pictures and the window share it. What techniques
/// draw it asks of their rows (viewer/techniques/registry), and knows none of them.
class Renderer final : private SceneDrawer {
 public:
  /// Uploads the scene; what a shading needs of the bake follows when it is first drawn. Throws Error when
  /// OpenGL cannot hold it and when the bake does not fit the scene.
  explicit Renderer(const RenderInputs& inputs, Lobe lobe = Lobe::Ggx);

  /// True when the inputs hold what a shading needs.
  bool canShade(Shading shading) const { return offers(inputs_, shading); }

  /// Draws the tile of the view into the whole of `target`, whose size is a multiple of the tile's.
  /// Lights the transfer anew when the view's lights have changed since it was last drawn. Throws Error for a
  /// shading that the inputs do not hold.
  void draw(const View& view, const Tile& tile, const gl::Framebuffer& target) {
    draw(view, tile, target, {});
  }

  /// Draws the tile and then its layers, one after the other, into the same target.
  void draw(const View& view, const Tile& tile, const gl::Framebuffer& target, const LayerRequest& layers);

  /// Draws all of a view as draw() does, in slices of about `seconds`, of which each that has pixels of the
  /// picture is told of. What shadow maps and environment maps lack is drawn before, in slices, too. Nothing
  /// else may be drawn or changed until the work is done or destroyed. `target` outlives the work.
  SlicedWork drawSliced(View view, const gl::Framebuffer& target, double seconds,
                        std::function<void(const SampleRect&)> drawn);

  /// Layers that pictures of a view have; debug views have none.
  std::vector<DrawnLayer> layersOf(const View& view) const {
    return view.debug.shown == DebugView::None ? viewer::layersOf(view, inputs_) : std::vector<DrawnLayer>();
  }

  /// Shows light of a shading that was found anew. Throws Error where it has not as many values as before,
  /// and for a shading that the inputs do not hold.
  void update(Shading shading, const FoundLight& light);

  /// Vertices of the scene are at other places: draws them there from now on. `shapes`: normals, triangles
  /// and what else vertices carry are others too. Baked light stays as it is.
  void sceneMoved(bool shapes = false);

  /// Materials of the scene are others, with the same textures; sceneMoved() has to follow.
  void materialsChanged();

  /// The posed bake of the inputs carries something else for a shading.
  void bakeChanged(Shading shading);

  /// The bake's transfer of some vertices is another now.
  void transferChanged(std::span<const VertexRange> ranges);

  /// True: redraws many shadow maps and environment maps over several pictures, as windows want it.
  void paceUpdates(bool pace) { pace_.spread = pace; }

  /// True: where occlusion is the mean of several pictures, a picture of one tile takes those drawn before
  /// it, as windows and sequences want it, rather than drawing all of them itself.
  void reuseOcclusion(bool reuse) { pace_.joined = reuse; }

  /// False: shaders have code for everything that any scene may have; pictures are the same, if slower.
  void specialiseShaders(bool specialise) { specialised_ = specialise; }

  /// Tells of every part of a picture when it has been drawn; empty: nobody.
  void observePasses(FramePassObserver observer) { observer_ = std::move(observer); }

  /// Further pictures of the view that was last drawn would show more of what has moved.
  bool isBehind() const;

  /// Returns the passes of a view besides its picture, such as shadow maps and environment maps.
  std::vector<PlannedPass> plan(const View& view);

  /// Adds notes on what a view approximates and what was chosen for it.
  void describe(const View& view, Warnings& notes);

 private:
  /// A shading's data in OpenGL and the light that it was last lit by.
  struct Drawn {
    std::unique_ptr<DrawnTransfer> transfer;  ///< nullptr where the shading has none
    const Bake* bake = nullptr;               ///< that it is of
    std::optional<Illumination> light;
    bool isMade = false;   ///< `transfer` is what it should be
    bool isStale = false;  ///< the scene has moved
  };

  using Passes = std::vector<TechniquePass*>;

  /// Inputs of drawScene().
  struct Drawing {
    const PictureState& picture;
    const Passes& passes;
    bool isFace = false;  ///< of a cube map
    LeftOut leftOut = {};
    bool withoutEmission = false;
    const LayerRequest* layers = nullptr;               ///< nullptr: none but the picture itself
    std::function<void(const SampleRect&)> drawn = {};  ///< is told of slices; empty: nobody is
  };

  /// Inputs of drawView(): a tile of a view, and how it is drawn.
  struct TileRequest {
    const View& view;
    Tile tile;
    const gl::Framebuffer& target;
    PicturePace pace;
    const LayerRequest* layers = nullptr;
    std::function<void(const SampleRect&)> drawn = {};
  };

  void drawFace(const PictureState& picture, const SceneFace& face, const gl::Framebuffer& target) override;
  FrameBlock useFrame(const View& view, const Tile& tile, std::span<const ShadedLight> lights,
                      int turns) const override;
  void bindTextures(const View& view) const override;

  OccluderEye eyeOf(const View& view) const;
  Illumination illuminationOf(const View& view);
  void updateLampTables();
  Drawn& drawnOf(Shading shading);
  Passes passesOf(Shading shading);
  const DrawnTransfer* litTransfer(const View& view, const Illumination& light,
                                   const FramePassObserver& passed);
  std::vector<ShadedLight> shownLights(const Drawing& drawing) const;
  ShaderVariant plainVariant(const View& view) const;
  ShaderVariant variantOf(const Drawing& drawing, std::span<const ShadedLight> lights) const;
  TileLook lookOf(const Drawing& drawing, std::span<const ShadedLight> lights) const;
  DrawOrder orderOf(const Drawing& drawing) const;
  SlicedWork drawView(TileRequest request);
  SlicedWork drawScene(Drawing drawing, Tile tile, const gl::Framebuffer& target);
  void drawOrdered(const Drawing& drawing, const DrawOrder& order, const TileLook& look,
                   const FramePassObserver& passed);
  void drawLayers(const Drawing& drawing, const DrawOrder& order, TileLook look,
                  const gl::Framebuffer& target);
  void drawBatches(const Passes& passes, const std::vector<const Batch*>& batches, const BatchLook& look);
  void clearToSky(const View& view, const BatchLook& look) const;

  RenderInputs inputs_;
  const CompiledScene& compiled_;
  Lobe lobe_;
  RenderScene scene_;
  std::array<Drawn, shadingCount> drawn_;
  std::optional<gl::BufferTexture> lampTables_;  ///< of lamps that have such
  std::size_t shownTables_ = 0;                  ///< version of those
  PicturePace pace_;
  ViewLights lights_;
  DrawnSky sky_;
  BatchDrawer batches_;
  DebugViews debug_;
  std::vector<std::unique_ptr<TechniquePass>> passes_;  ///< [row]; nullptr before a picture has had it
  std::optional<Shading> shown_;                        ///< by the last picture
  bool specialised_ = true;
  FramePassObserver observer_;
  gl::Buffer frameBlock_;
  gl::Buffer lightBlock_;
};

}  // namespace prelight::viewer
