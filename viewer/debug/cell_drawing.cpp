#include "viewer/debug/cell_drawing.h"

#include "viewer/core/camera.h"
#include "viewer/debug/picture_fill.h"
#include "viewer/techniques/caustics/caustic_pass.h"

namespace prelight::viewer {
namespace {

class CellDrawing final : public DebugDrawing {
 public:
  CellDrawing(const std::vector<device::Photon>& caustics, const DebugInputs& of)
      : scene_(of.scene),
        batches_(of.batches),
        pass_({caustics, CausticFilter{}}, of.inputs.compiled),
        fill_("debug_cells.frag") {}

  void draw(const DebugTile& tile) override;

 private:
  const RenderScene& scene_;
  BatchDrawer& batches_;
  CausticPass pass_;
  PictureFill fill_;
};

void CellDrawing::draw(const DebugTile& tile) {
  const LevelRaster raster = rasterAround(tile.tile, tile.view.height, 0, CausticPass::margin);
  const double pixelWidth = 2.0 * halfHeightOf(tile.view.camera) / tile.view.height;
  tile.drawer.useFrame(tile.view, raster.tile(tile.view.height), {}, tile.samples());
  BatchLook surfaces;
  surfaces.shader = "surface_places.frag";
  surfaces.ofSurfaces = {Feature::BaseColorTexture, Feature::Cutouts};
  batches_.drawInto(pass_.places(raster), tile.order.opaque, surfaces);
  pass_.drawPhotons(raster, pixelWidth, scene_.triangleNormals());
  tile.target.bind();
  const gl::Program& program = fill_.use();
  program.set("marks", 0);
  program.set("cells", glm::ivec4(tile.samples(), CausticPass::cellSide, CausticPass::margin, 0));
  program.set("brightness", static_cast<float>(1.0 / tile.view.debug.exposure));
  gl::bind(0, GL_TEXTURE_2D, pass_.marks());
  fill_.draw(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace

std::unique_ptr<DebugDrawing> drawCells(const std::vector<device::Photon>& caustics, const DebugInputs& of) {
  return std::make_unique<CellDrawing>(caustics, of);
}

}  // namespace prelight::viewer
