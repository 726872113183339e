#include <memory>

#include "gi/global_illumination.h"
#include "prelight/error.h"
#include "techniques/light_map/light_map_fit.h"
#include "viewer/programs/drawn_shading.h"
#include "viewer/shadows/shadowed_lighting.h"
#include "viewer/techniques/light_map/light_map_lighting.h"

namespace prelight::viewer {
namespace {

/// All light: lights with the shadows of their maps, and indirect light of a light map.
class GlobalIlluminationLighting final : public ShadowedLighting {
 public:
  /// Everything outlives it.
  GlobalIlluminationLighting(const LightMap& indirect, const CompiledScene& compiled,
                             const RenderScene& scene)
      : ShadowedLighting(compiled, scene), indirect_(indirect, compiled) {}

  void bind(const gl::Program& program) const override {
    indirect_.bind(program);
    ShadowedLighting::bind(program);
  }

  void takeLight(const FoundLight& light) override {
    if (!light.indirect.empty()) indirect_.fill(light.indirect);
  }

 private:
  LightMapLighting indirect_;
};

void checkFullLight(const RenderInputs& inputs) {
  if (inputs.globalIllumination == nullptr) return;
  requireLightMap(inputs.globalIllumination->indirect, inputs.compiled);
  for (const device::Photon& photon : inputs.globalIllumination->photons)
    if (photon.triangle >= inputs.compiled.triangleCount())
      throw Error(ExitCode::RuntimeFailure, "photons of caustics", "they belong to another scene");
}

constexpr ShadingInfo fullShading = {
    .shading = Shading::GlobalIllumination,
    .summary = "all light, with caustics, mirrors and glass",
    .rules = {{"indirect_map.glsl"}, Reflection::Everywhere, Through::None},
    .traits = {.allLight = true,
               .causticsOfItsOwn = true,
               .areaLightsAsSamples = true,
               .followsAnimation = true,
               .movableNodes = true},
    .carriedBy = [](const Bake&) { return false; },
};

}  // namespace

extern const DrawnShading drawnFull = {
    .info = &fullShading,
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<DrawnTransfer> {
      return std::make_unique<GlobalIlluminationLighting>(of.inputs.globalIllumination->indirect,
                                                          of.inputs.compiled, of.scene);
    },
    .shader = "global_illumination.frag",
    .offered = [](const RenderInputs& inputs) { return inputs.globalIllumination != nullptr; },
    .missing = "its indirect light is not among the inputs",
    .cure = "compute it with computeGlobalIllumination",
    .check = checkFullLight,
};

}  // namespace prelight::viewer
