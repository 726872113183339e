#include "viewer/global_illumination_lighting.h"

namespace prelight::viewer {

GlobalIlluminationLighting::GlobalIlluminationLighting(const GlobalIllumination& globalIllumination,
                                                       const CompiledScene& compiled,
                                                       const RenderScene& scene)
    : compiled_(compiled), scene_(scene), indirect_(globalIllumination.indirect, compiled) {}

void GlobalIlluminationLighting::light(const Illumination& light) {
  shadows_.update(scene_, compiled_, light.lights, moved_, effort_);
  moved_ = false;
}

void GlobalIlluminationLighting::bind(const gl::Program& program) const {
  indirect_.bind(program);
  shadows_.bind();
}

void GlobalIlluminationLighting::describe(const Illumination&, Warnings&) const {}

void GlobalIlluminationLighting::updateIndirect(std::span<const float> values) { indirect_.fill(values); }

}  // namespace prelight::viewer
