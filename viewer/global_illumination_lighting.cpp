#include "viewer/global_illumination_lighting.h"

namespace prelight::viewer {

GlobalIlluminationLighting::GlobalIlluminationLighting(const GlobalIllumination& globalIllumination,
                                                       const CompiledScene& compiled,
                                                       const RenderScene& scene)
    : ShadowedLighting(compiled, scene), indirect_(globalIllumination.indirect, compiled) {}

void GlobalIlluminationLighting::bind(const gl::Program& program) const {
  indirect_.bind(program);
  ShadowedLighting::bind(program);
}

void GlobalIlluminationLighting::updateIndirect(std::span<const float> values) { indirect_.fill(values); }

}  // namespace prelight::viewer
