#include "viewer/shadowed_lighting.h"

namespace prelight::viewer {

void ShadowedLighting::light(const Illumination& light) {
  shadows_.update(scene_, compiled_, light.lights, moved_, effort_);
  moved_ = false;
}

void ShadowedLighting::bind(const gl::Program&) const { shadows_.bind(); }

void ShadowedLighting::describe(const Illumination&, Warnings&) const {}

}  // namespace prelight::viewer
