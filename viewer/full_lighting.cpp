#include "viewer/full_lighting.h"

namespace prelight::viewer {

FullLighting::FullLighting(const GlobalIllumination& full, const CompiledScene& compiled,
                           const RenderScene& scene)
    : compiled_(compiled), scene_(scene), indirect_(full.indirect, compiled) {}

void FullLighting::light(const Illumination& light) {
  shadows_.update(scene_, compiled_, light.lights, moved_, mostSampleViews_);
  moved_ = false;
}

void FullLighting::bind(const gl::Program& program) const {
  indirect_.bind(program);
  shadows_.bind();
}

void FullLighting::describe(const Illumination&, Warnings&) const {}

void FullLighting::updateIndirect(std::span<const float> values) { indirect_.fill(values); }

}  // namespace prelight::viewer
