#include "viewer/debug/surface_colors.h"

#include <optional>

#include "viewer/gl/program.h"
#include "viewer/gl/texture.h"
#include "viewer/programs/surface_input.h"
#include "viewer/programs/texture_units.h"
#include "viewer/techniques/light_map/light_map_lighting.h"

namespace prelight::viewer {
namespace {

constexpr float farAway = 1e30f;  ///< m, as background.frag has it

/// Colours with an unused fourth number, and one that stands for none.
gl::BufferTexture uploadColors(const std::vector<glm::vec3>& colors) {
  std::vector<glm::vec4> texels;
  texels.reserve(colors.size() + 1);
  for (const glm::vec3& color : colors) texels.emplace_back(color, 0.0f);
  if (texels.empty()) texels.emplace_back(0.0f);
  return gl::makeBufferTexture(texels, "colours of a debug view");
}

gl::BufferTexture uploadCorners(const LightMapLayout* layout) {
  std::vector<glm::vec2> corners;
  if (layout != nullptr) corners = lightMapCorners(*layout);
  if (corners.empty()) corners.emplace_back(-1.0f);
  return gl::makeBufferTexture(std::span<const glm::vec2>(corners), 1, GL_RG32F, "light map coordinates");
}

class SurfaceDrawing final : public DebugDrawing, private SurfaceInput {
 public:
  SurfaceDrawing(const SurfaceColors& colors, const DebugInputs& of)
      : batches_(of.batches),
        coloring_(colors.coloring),
        hasVertexColors_(of.inputs.compiled.hasVertexColors()),
        frontFaces_(static_cast<int>(of.inputs.compiled.triangleCount())),
        mapWidth_(colors.layout != nullptr ? colors.layout->width : 1),
        legend_(colors.legend),
        colors_(uploadColors(colors.colors)),
        corners_(uploadCorners(colors.layout)) {}

  bool replacesSurfaces() const override { return true; }
  std::string legend() const override { return legend_; }
  void draw(const DebugTile& tile) override;

 private:
  void bind(const gl::Program& program) const override;

  BatchDrawer& batches_;
  Coloring coloring_;
  bool hasVertexColors_;
  int frontFaces_;
  int mapWidth_;
  float brightness_ = 1.0f;
  std::string legend_;
  gl::BufferTexture colors_, corners_;
};

void SurfaceDrawing::bind(const gl::Program& program) const {
  program.set("coloring", static_cast<int>(coloring_));
  program.set("frontFaces", frontFaces_);
  program.set("mapWidth", mapWidth_);
  program.set("brightness", brightness_);
  program.set("debugColors", static_cast<int>(lightMapWallsUnit));  // whose own texture its programs lack
  gl::bind(lightMapWallsUnit, GL_TEXTURE_BUFFER, colors_.texture);
  gl::bind(lightMapCornersUnit, GL_TEXTURE_BUFFER, corners_.texture);
}

void SurfaceDrawing::draw(const DebugTile& tile) {
  brightness_ = static_cast<float>(1.0 / tile.view.debug.exposure);
  glClearColor(0.0f, 0.0f, 0.0f, farAway);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  BatchLook look;
  look.shader = "debug_surface.frag";
  look.variant.features.add(Feature::VertexColors, hasVertexColors_);
  look.inputs = {this};
  batches_.draw(tile.order.opaque, look);
  batches_.draw(tile.order.blended, look);
}

}  // namespace

std::unique_ptr<DebugDrawing> drawSurfaceColors(const SurfaceColors& colors, const DebugInputs& of) {
  return std::make_unique<SurfaceDrawing>(colors, of);
}

}  // namespace prelight::viewer
