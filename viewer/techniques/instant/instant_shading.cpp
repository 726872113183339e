#include <memory>

#include "viewer/programs/drawn_shading.h"
#include "viewer/shadows/shadowed_lighting.h"
#include "viewer/techniques/instant/virtual_light_maps.h"

namespace prelight::viewer {
namespace {

/// Instant radiosity (Keller 1997): lights with the shadows of their maps, and indirect light of virtual
/// lights with theirs, of which those grow old that nothing has changed but what they see (Laine et al.
/// 2007).
class InstantRadiosityLighting final : public ShadowedLighting {
 public:
  /// Everything but the set outlives it.
  InstantRadiosityLighting(const VirtualLightSet& set, const CompiledScene& compiled,
                           const RenderScene& scene)
      : ShadowedLighting(compiled, scene) {
    show(set);
  }

  void prepare(const PictureState& picture) override {
    ShadowedLighting::prepare(picture);
    const bool few = picture.pace.spread && renewals_ > 0;
    maps_.update(scene(), compiled(), few ? renewals_ : VirtualLightMaps::everything);
    picture.passed({FramePass::VirtualLights, maps_.viewsDrawn()});
  }

  void bind(const gl::Program& program) const override {
    ShadowedLighting::bind(program);
    maps_.bind(program);
  }

  bool verticesMoved() override {
    maps_.sceneMoved();
    return ShadowedLighting::verticesMoved();
  }

  bool isBehind() const override { return ShadowedLighting::isBehind() || maps_.isBehind(); }

  /// Virtual lights are too few and too different for pixels to share them: glass shows which pixel had
  /// which.
  int turnsInFaces() const override { return 1; }

  void takeLight(const FoundLight& light) override {
    if (light.virtualLights != nullptr) show(*light.virtualLights);
  }

 private:
  void show(const VirtualLightSet& set) {
    maps_.set(set);
    renewals_ = set.renewals;
  }

  VirtualLightMaps maps_;
  std::size_t renewals_ = 0;
};

constexpr ShadingInfo instantShading = {
    .shading = Shading::Instant,
    .summary = "all light, that of surfaces from virtual lights with shadow maps",
    .rules = {{"indirect_lights.glsl"}, Reflection::Everywhere, Through::None},
    .traits = {.allLight = true, .areaLightsAsSamples = true, .movableNodes = true},
    .carriedBy = [](const Bake&) { return false; },
};

}  // namespace

extern const DrawnShading drawnInstant = {
    .info = &instantShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<InstantRadiosityLighting>(*of.inputs.virtualLights, of.inputs.compiled,
                                                        of.scene);
    },
    .shader = "global_illumination.frag",
    .offered = [](const RenderInputs& inputs) { return inputs.virtualLights != nullptr; },
    .missing = "its virtual lights are not among the inputs",
    .cure = "make them with LiveVirtualLights",
};

}  // namespace prelight::viewer
