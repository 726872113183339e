#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "viewer/core/occlusion_options.h"
#include "viewer/core/view_state.h"
#include "viewer/lights/illumination.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/programs/sliced_drawing.h"
#include "viewer/programs/technique_pass.h"
#include "viewer/techniques/screen/disks/disk_occlusion.h"
#include "viewer/techniques/screen/fields/field_occlusion.h"
#include "viewer/techniques/screen/occlusion_band.h"
#include "viewer/techniques/screen/occlusion_history.h"
#include "viewer/techniques/screen/occlusion_pass.h"

namespace prelight::viewer {
namespace {

constexpr Ambient screenLight{
    "screen_light_ambient.glsl"};  // the sky and lamps that OcclusionPass finds with Ssdo
constexpr Ambient screenBounce{"screen_bounce_ambient.glsl"};  // that, and what surfaces send on
constexpr Ambient screenSender{"screen_sender_ambient.glsl"};  // of what sends it on: nothing but that light

/// A tile of a view, and what around it has to be drawn to find what occludes it.
struct ScreenTile {
  ScreenOcclusionOptions options;
  OcclusionPicture picture;
  Tile whole;       ///< with the band around it
  int samples = 1;  ///< along a side of a pixel
  bool isAllOfView = false;
};

ScreenTile screenTileOf(const TileState& state, const CompiledScene& scene) {
  const View& view = state.picture.view;
  const Tile& tile = state.tile;
  const gl::Framebuffer& target = state.target;
  const int samples = target.width() / tile.width;
  const double radius = occlusionRadius(view.screenOcclusion, scene);
  const ScreenOcclusionOptions options = view.draft ? draftOf(view.screenOcclusion) : view.screenOcclusion;
  const int around =
      looksAround(options) ? occlusionMargin(view, samples, radius, scene) : OcclusionPass::filterReach;
  const glm::ivec2 origin(tile.x * samples, (view.height - tile.y - tile.height) * samples);
  return {options,
          {target.width(), target.height(), around * samples, origin, radius, state.picture.pace.slice},
          {tile.x - around, tile.y - around, tile.width + 2 * around, tile.height + 2 * around},
          samples,
          tile.width == view.width && tile.height == view.height};
}

/// How what is found is shown, and under which light.
struct ScreenLook {
  const FrameBlock& frame;  ///< in use: of the tile with its band
  const BatchLook& look;
  const Illumination& light;
};

/// Occlusion and light that are found in pictures, from one picture to the next.
class ScreenShading final : public TechniquePass {
 public:
  /// The inputs' device may be null, where fields are not asked for.
  explicit ScreenShading(const TechniqueInputs& of)
      : scene_(of.inputs.compiled), device_(of.inputs.device), batches_(of.batches) {}

  /// Leaves what is found of every sample of the tile bound for surface.frag.
  SlicedWork drawTile(TileState tile, SceneDrawer& drawer, TileLook& look) override;
  void prepare(const PictureState&, SceneDrawer&) override { isBehind_ = false; }
  void sceneMoved() override;

  /// The next picture of the same view joins more of them.
  bool isBehind() const override { return isBehind_; }

 private:
  SlicedWork draw(const ScreenTile& tile, const std::vector<const Batch*>& opaque, const ScreenLook& shown,
                  bool joins);
  SlicedWork drawLayers(const ScreenTile& tile, const std::vector<const Batch*>& opaque);
  SlicedWork drawSent(const ScreenTile& tile, const std::vector<const Batch*>& opaque,
                      const ScreenLook& shown, const OcclusionLight& light);
  void prepareScene(const ScreenTile& tile, const std::vector<const Batch*>& opaque);
  OcclusionLight lightOf(const ScreenTile& tile, const ScreenLook& shown);
  SlicedWork find(const ScreenTile& tile, const OcclusionLight& light, const FrameBlock& frame, bool goesOn);

  const CompiledScene& scene_;
  const Device* device_;
  BatchDrawer& batches_;
  std::unique_ptr<DiskOcclusion> disks_;    ///< made when they first occlude
  std::unique_ptr<FieldOcclusion> fields_;  ///< the same
  OcclusionPass pass_;
  OcclusionHistory history_;
  std::optional<Illumination> light_;  ///< of the last picture that light was found of
  bool moved_ = false;                 ///< the scene has, since occlusion was last found
  bool isBehind_ = false;
  const gl::Framebuffer* found_ = nullptr;  ///< the occlusion that find() has found
};

void bindFound(const gl::Framebuffer& found, const ScreenOcclusionOptions& options) {
  constexpr std::array<Unit, OcclusionPass::mostOutputs> units = {screenInputUnit, screenLampsUnit,
                                                                  screenBounceUnit};
  for (int i = 0; i < OcclusionPass::outputsOf(options); ++i)
    gl::bind(units[static_cast<std::size_t>(i)], GL_TEXTURE_2D, found.color(i));
}

}  // namespace

/// Draws the surfaces that occlude, or send light, in a picture and around it.
SlicedWork ScreenShading::drawLayers(const ScreenTile& tile, const std::vector<const Batch*>& opaque) {
  BatchLook look;
  look.shader = "screen_surface.frag";
  for (look.layer = 0; look.layer < layersOf(tile.options); ++look.layer) {
    const gl::Framebuffer& target = pass_.layer(look.layer, tile.picture);
    SlicedWork layer =
        drawInSlices(target.width(), target.height(), tile.picture.slice, [&](const SampleRect&) {
          if (look.layer > 0)
            gl::bind(screenInputUnit, GL_TEXTURE_2D, pass_.layer(look.layer - 1, tile.picture).color());
          useSurfaceState();
          batches_.drawInto(target, opaque, look);
        });
    while (layer.goOn()) co_await endOfSlice;
  }
}

/// Draws the light that surfaces of a picture and around it send.
SlicedWork ScreenShading::drawSent(const ScreenTile& tile, const std::vector<const Batch*>& opaque,
                                   const ScreenLook& shown, const OcclusionLight& light) {
  SlicedWork finding = pass_.drawSenders(tile.picture, tile.options, light);
  while (finding.goOn()) co_await endOfSlice;
  bindFound(pass_.ofSenders(), tile.options);
  BatchLook senders = shown.look;
  senders.variant.rules.ambient = screenSender;
  senders.causticCorner = glm::ivec4(0);
  const gl::Framebuffer& sent = pass_.sent(tile.picture);
  SlicedWork sending = drawInSlices(sent.width(), sent.height(), tile.picture.slice, [&](const SampleRect&) {
    useSurfaceState();
    batches_.drawInto(sent, opaque, senders);
  });
  while (sending.goOn()) co_await endOfSlice;
}

/// Makes ready what of the scene occludes, seen or not, where a method looks at that.
void ScreenShading::prepareScene(const ScreenTile& tile, const std::vector<const Batch*>& opaque) {
  if (tile.options.method == OcclusionMethod::Disks) {
    if (disks_ == nullptr) disks_ = std::make_unique<DiskOcclusion>(scene_);
    disks_->prepare(tile.options, tile.picture.radius, OcclusionPass::disksUnit);
  }
  if (tile.options.method != OcclusionMethod::Fields) return;
  if (fields_ == nullptr) fields_ = std::make_unique<FieldOcclusion>(scene_, device_);
  fields_->prepare(tile.options, tile.picture.radius);
  BatchLook look;
  look.shader = "screen_owner.frag";
  look.inputs = {fields_.get()};
  batches_.drawInto(pass_.layer(1, tile.picture), opaque, look);
  fields_->attach(OcclusionPass::fieldsUnit);
}

/// Pictures under other light are not joined.
OcclusionLight ScreenShading::lightOf(const ScreenTile& tile, const ScreenLook& shown) {
  OcclusionLight light;
  if (tile.options.method != OcclusionMethod::Ssdo) return light;
  for (const Feature feature : {Feature::SkyLight, Feature::SkyMap})
    light.sky.add(feature, shown.look.variant.features.has(feature));
  light.lamps = std::min(shown.frame.counts.y, OcclusionPass::mostLamps);
  if (light_ != shown.light) history_.drop();
  light_ = shown.light;
  return light;
}

/// Finds the occlusion of the picture alone, or joined with pictures before it.
SlicedWork ScreenShading::find(const ScreenTile& tile, const OcclusionLight& light, const FrameBlock& frame,
                               bool goesOn) {
  const int frames = tile.options.frames;
  const bool joins = frames > 1;
  if (joins && !goesOn) history_.drop();
  for (int i = 0; i < (goesOn ? 1 : frames); ++i) {
    SlicedWork finding = pass_.draw(tile.picture, tile.options, light, joins ? history_.turn() : 0);
    while (finding.goOn()) co_await endOfSlice;
    found_ = &pass_.found();
    if (!joins) co_return;
    found_ = &history_.join(*found_, pass_.layer(0, tile.picture), tile.picture,
                            {frame, frames, goesOn && moved_});
  }
  isBehind_ = goesOn && history_.stillPictures() < frames;
  moved_ = false;
}

SlicedWork ScreenShading::drawTile(TileState tile, SceneDrawer& drawer, TileLook& look) {
  const View& view = tile.picture.view;
  const ScreenTile part = screenTileOf(tile, scene_);
  const FrameBlock frame = drawer.useFrame(view, part.whole, tile.lights, part.samples);
  drawer.bindTextures(view);
  const ScreenLook shown{frame, look.opaque, tile.picture.light};
  SlicedWork drawing = draw(part, tile.opaque, shown, tile.picture.pace.joined);
  while (drawing.goOn()) co_await endOfSlice;
  if (view.screenOcclusion.method == OcclusionMethod::Ssdo)
    look.opaque.variant.rules.ambient = gathers(view.screenOcclusion) ? screenBounce : screenLight;
  look.blended.variant.rules.ambient = Ambient::Open;  // what was found lies on what is opaque
  tile.picture.passed({FramePass::ScreenOcclusion});
}

SlicedWork ScreenShading::draw(const ScreenTile& tile, const std::vector<const Batch*>& opaque,
                               const ScreenLook& shown, bool joins) {
  SlicedWork layers = drawLayers(tile, opaque);
  while (layers.goOn()) co_await endOfSlice;
  prepareScene(tile, opaque);
  const OcclusionLight light = lightOf(tile, shown);
  if (gathers(tile.options)) {
    SlicedWork sent = drawSent(tile, opaque, shown, light);
    while (sent.goOn()) co_await endOfSlice;
  }
  SlicedWork finding = find(tile, light, shown.frame, joins && tile.isAllOfView);
  while (finding.goOn()) co_await endOfSlice;
  bindFound(*found_, tile.options);
}

void ScreenShading::sceneMoved() {
  if (disks_ != nullptr) disks_->sceneMoved();
  if (fields_ != nullptr) fields_->sceneMoved();
  moved_ = true;
}

namespace {

constexpr ShadingInfo screenInfo = {
    .shading = Shading::Screen,
    .summary = "like ao, with occlusion found in the picture itself",
    .rules = {Ambient::Screen, Reflection::Everywhere, Through::None},
    .traits = {.skyLampsApart = true, .accessibility = true, .creaseCorrection = true},
};

}  // namespace

extern const DrawnShading drawnScreen = {.info = &screenInfo};

extern const PassRow screenRow = {
    .isIn = [](Shading shading,
               const RenderInputs&) { return infoOf(shading).rules.ambient == Ambient::Screen; },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<ScreenShading>(of);
    },
};

}  // namespace prelight::viewer
