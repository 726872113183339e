#include <memory>
#include <vector>

#include "gi/global_illumination.h"
#include "viewer/core/camera.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/programs/texture_units.h"
#include "viewer/techniques/caustics/caustic_pass.h"

namespace prelight::viewer {
namespace {

/// Caustics of the inputs, or of their light where they have none.
Caustics causticsAmong(const RenderInputs& inputs) {
  if (inputs.caustics != nullptr) return *inputs.caustics;
  if (inputs.globalIllumination == nullptr) return {};
  return {inputs.globalIllumination->photons, inputs.globalIllumination->caustics.filter};
}

/// Caustics in pictures: filtered for each tile and what lies around it, once per pixel, as photons are too
/// few for more.
class CausticTechnique final : public TechniquePass {
 public:
  explicit CausticTechnique(const TechniqueInputs& of)
      : compiled_(of.inputs.compiled), scene_(of.scene), batches_(of.batches) {
    show(causticsAmong(of.inputs));
  }

  void addFeatures(Features& features) const override { features.add(Feature::Caustics, !empty()); }
  SlicedWork drawTile(TileState tile, SceneDrawer& drawer, TileLook& look) override;
  void takeLight(const FoundLight& light) override {
    if (light.caustics != nullptr) show(*light.caustics);
  }

 private:
  bool empty() const { return pass_ == nullptr || pass_->empty(); }
  void show(const Caustics& caustics) {
    if (pass_ != nullptr)
      pass_->update(caustics, compiled_);
    else if (!caustics.photons.empty())
      pass_ = std::make_unique<CausticPass>(caustics, compiled_);
  }

  const CompiledScene& compiled_;
  const RenderScene& scene_;
  BatchDrawer& batches_;
  std::unique_ptr<CausticPass> pass_;  ///< made with the first photons
};

SlicedWork CausticTechnique::drawTile(TileState tile, SceneDrawer& drawer, TileLook& look) {
  if (empty()) co_return;
  const View& view = tile.picture.view;
  const int samples = tile.target.width() / tile.tile.width;
  const double pixelWidth = 2.0 * halfHeightOf(view.camera) / view.height;
  const CameraMatrices camera =
      cameraMatrices(view.camera, compiled_, static_cast<double>(view.width) / view.height);
  const int levels = pass_->levelsFor(camera, pixelWidth);
  std::vector<LevelRaster> rasters;
  for (int level = 0; level < levels; ++level) {
    rasters.push_back(rasterAround(tile.tile, view.height, level, CausticPass::margin));
    drawer.useFrame(view, rasters.back().tile(view.height), {}, samples);
    BatchLook surfaces;
    surfaces.shader = "surface_places.frag";
    surfaces.ofSurfaces = {Feature::BaseColorTexture, Feature::Cutouts};
    batches_.drawInto(pass_->places(rasters.back()), tile.opaque, surfaces);
    pass_->drawPhotons(rasters.back(), pixelWidth, scene_.triangleNormals());
  }
  pass_->filter(rasters, pixelWidth, scene_.triangleNormals());
  gl::bind(causticsUnit, GL_TEXTURE_2D, pass_->irradiance());
  // Caustics lie on what is opaque.
  look.opaque.causticCorner = {CausticPass::margin, CausticPass::margin, 0, samples};
  tile.picture.passed({FramePass::Caustics});
  if (tile.picture.pace.slice < PictureSlices::unbounded) {
    gl::Framebuffer::finish();
    co_await endOfSlice;
  }
}

}  // namespace

extern const PassRow causticRow = {
    .isIn =
        [](Shading shading, const RenderInputs& inputs) {
          return inputs.caustics != nullptr || infoOf(shading).traits.causticsOfItsOwn;
        },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<CausticTechnique>(of);
    },
};

}  // namespace prelight::viewer
