#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "relight/vertex_lights.h"
#include "viewer/core/camera.h"
#include "viewer/core/view_state.h"
#include "viewer/cubes/object_cubes.h"
#include "viewer/cubes/surroundings.h"
#include "viewer/frame/frame_pass.h"
#include "viewer/frame/picture_layers.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/gl/texture.h"
#include "viewer/lights/drawn_sky.h"
#include "viewer/lights/illumination.h"
#include "viewer/lights/view_lights.h"
#include "viewer/programs/batch_drawer.h"
#include "viewer/programs/draw_order.h"
#include "viewer/scene/render_scene.h"
#include "viewer/techniques/caustics/caustic_pass.h"
#include "viewer/techniques/full/global_illumination_lighting.h"
#include "viewer/techniques/instant/instant_radiosity_lighting.h"
#include "viewer/techniques/near_lamps/near_lamp_pass.h"
#include "viewer/techniques/registry/techniques.h"
#include "viewer/techniques/screen/screen_shading.h"

namespace prelight::viewer {

/// Draws a scene with the current OpenGL context; headless pictures and the window share it.
class Renderer {
 public:
  /// Uploads the scene; what a shading needs of the bake follows when it is first drawn. Throws Error when
  /// OpenGL cannot hold it and when the bake does not fit the scene.
  explicit Renderer(const RenderInputs& inputs, Lobe lobe = Lobe::Ggx);

  /// True when the bake carries what a shading needs; for GlobalIllumination and Instant: when their light is
  /// among the inputs.
  bool canShade(Shading shading) const;

  /// Draws the tile of the view into the whole of `target`, whose size is a multiple of the tile's.
  /// Lights the transfer anew when the view's lights have changed since it was last drawn. Throws Error for a
  /// shading that the bake does not carry.
  void draw(const View& view, const Tile& tile, const gl::Framebuffer& target) {
    draw(view, tile, target, {});
  }

  /// Draws the tile and then its layers, one after the other, into the same target.
  void draw(const View& view, const Tile& tile, const gl::Framebuffer& target, const LayerRequest& layers);

  /// Layers that pictures of a view have.
  std::vector<DrawnLayer> layersOf(const View& view) const { return viewer::layersOf(view, inputs_); }

  /// Replaces the indirect light of global illumination, W/m2, [y][x][channel 3] of the inputs' light map.
  /// Throws Error for another number of values.
  void updateIndirect(std::span<const float> values);

  /// Replaces the caustics of global illumination.
  void updateCaustics(const Caustics& caustics);

  /// Replaces the virtual lights of instant shading.
  void updateVirtualLights(const VirtualLightSet& lights);

  /// Replaces the irradiance of radiosity shading, W/m2, [vertex]; light in an encoding stays as it is.
  /// Throws Error for another number of values, and when the bake has no radiosity.
  void updateIrradiance(std::span<const glm::vec3> irradiance);

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
  void paceUpdates(bool pace) { paced_ = pace; }

  /// True: where occlusion is the mean of several pictures, a picture of one tile takes those drawn before
  /// it, as windows and sequences want it, rather than drawing all of them itself.
  void reuseOcclusion(bool reuse) { reusesOcclusion_ = reuse; }

  /// False: shaders have code for everything that any scene may have; pictures are the same, if slower.
  void specialiseShaders(bool specialise) { specialised_ = specialise; }

  /// Tells of every part of a picture when it has been drawn; empty: nobody.
  void observePasses(FramePassObserver observer) { observer_ = std::move(observer); }

  /// Further pictures of the same view would show more of what has moved.
  bool isBehind() const;

  /// The passes that global illumination draws for a view besides its picture: shadow maps and environment
  /// maps.
  std::vector<PlannedPass> plan(const View& view);

  /// Adds notes on what a view approximates and what was chosen for it.
  void describe(const View& view, Warnings& notes);

  /// The virtual lights of instant shading and their maps; nullptr before it is drawn.
  const VirtualLightMaps* virtualLights() const {
    return instant_ == nullptr ? nullptr : &instant_->virtualLights();
  }

  /// Squares of shadow maps that global illumination drew anew for its last picture.
  std::size_t shadowViewsDrawn() const {
    return globalIllumination_ == nullptr ? 0 : globalIllumination_->shadows().viewsDrawn();
  }

  /// Their texels.
  std::size_t shadowTexelsDrawn() const {
    return globalIllumination_ == nullptr ? 0 : globalIllumination_->shadows().texelsDrawn();
  }

  /// Faces of environment maps that it drew anew for its last picture.
  std::size_t surroundingFacesDrawn() const {
    return surroundings_ == nullptr ? 0 : surroundings_->facesDrawn();
  }

  /// The cube maps that light objects of the inputs; nullptr before they are drawn.
  const ObjectCubes* objectCubes() const { return cubes_.get(); }

  /// Caustics of the last tile; nullptr where the inputs have none.
  const CausticPass* caustics() const { return caustics_.get(); }

 private:
  /// A technique in OpenGL and the light that it was last lit by.
  struct Drawn {
    std::unique_ptr<DrawnTransfer> transfer;  ///< nullptr where the shading has none
    const Bake* bake = nullptr;               ///< that it is of
    std::optional<Illumination> light;
    bool isMade = false;   ///< `transfer` is what it should be
    bool isStale = false;  ///< the scene has moved
  };

  void passed(FramePass pass) const {
    if (observer_) observer_(pass);
  }
  OccluderEye eyeOf(const View& view) const;
  Illumination illuminationOf(const View& view);
  void updateLampTables();
  Drawn& drawnOf(Shading shading);
  const DrawnTransfer* litTransfer(const View& view, const Illumination& light);
  GlobalIlluminationLighting& globalIllumination();
  InstantRadiosityLighting& instantRadiosity();
  ShadowedLighting& shadowedLighting(Shading shading);
  void makeSurroundings();
  const Bake* bakeOf(Shading shading) const;
  NearLampPass* nearLampsOf(Shading shading) const;
  std::vector<ShadedLight> shownLights(const View& view, const Illumination& light) const;
  DrawingRules rulesFor(const View& view) const;
  ShaderVariant variantOf(const View& view, std::span<const ShadedLight> lights) const;
  bool showsCaustics(const View& view) const;
  void updateSurroundings(const View& view, const Illumination& light, const ShadowedLighting& lighting);
  void updateObjectCubes(const View& view, const Illumination& light, const DrawnTransfer* transfer);
  /// Inputs of drawScene().
  struct Drawing {
    const View& view;
    const Illumination& light;
    const DrawnTransfer* transfer = nullptr;
    LeftOut leftOut = {};  ///< of a cube map
    bool withoutEmission = false;
    const LayerRequest* layers = nullptr;  ///< nullptr: none but the picture itself
  };
  void drawScene(const Drawing& drawing, const Tile& tile, const gl::Framebuffer& target);
  void drawOrdered(const View& view, const DrawOrder& order, BatchLook look, bool observed);
  BatchLook lookOf(const Drawing& drawing, std::span<const ShadedLight> lights) const;
  const ObjectCubes* cubesOf(const View& view) const;
  void drawBatches(const View& view, const std::vector<const Batch*>& batches, const BatchLook& look);
  FrameBlock uploadFrame(const View& view, const Tile& tile, std::span<const ShadedLight> lights,
                         int turns) const;

  void clearToSky(const View& view, const BatchLook& look) const;

  /// How a picture is drawn, and under which light.
  struct ShownLight {
    const BatchLook& look;
    std::span<const ShadedLight> lights;
    const Illumination& light;
  };

  void drawScreenOcclusion(const View& view, const Tile& tile, const gl::Framebuffer& target,
                           const std::vector<const Batch*>& opaque, const ShownLight& shown);
  glm::ivec4 drawCaustics(const View& view, const Tile& tile, const gl::Framebuffer& target,
                          const std::vector<const Batch*>& opaque);
  void makeCaustics(const Caustics& caustics);
  void bindTextures(const View& view) const;

  RenderInputs inputs_;
  const CompiledScene& compiled_;
  Lobe lobe_;
  RenderScene scene_;
  std::array<Drawn, shadingCount> drawn_;
  std::unique_ptr<GlobalIlluminationLighting> globalIllumination_;
  std::unique_ptr<InstantRadiosityLighting> instant_;
  std::unique_ptr<Surroundings> surroundings_;  ///< of both
  std::unique_ptr<NearLampPass> nearLamps_;     ///< where the bake has shells of distance
  std::unique_ptr<ObjectCubes> cubes_;          ///< where the inputs have objects for them
  std::optional<Illumination> surroundedBy_;
  const ShadowedLighting* surroundedWith_ = nullptr;
  std::optional<gl::BufferTexture> lampTables_;  ///< of lamps that have such
  std::size_t shownTables_ = 0;                  ///< version of those
  bool surroundedCoarsely_ = false;              ///< with the shadows of a draft
  bool paced_ = false;
  ViewLights lights_;
  DrawnSky sky_;
  BatchDrawer batches_;
  bool specialised_ = true;
  FramePassObserver observer_;
  std::unique_ptr<CausticPass> caustics_;
  std::unique_ptr<ScreenShading> screen_;  ///< made when screen shading is first drawn
  bool reusesOcclusion_ = false;
  gl::Buffer frameBlock_;
  gl::Buffer lightBlock_;
};

}  // namespace prelight::viewer
