#include "viewer/techniques/instant/instant_radiosity_lighting.h"

namespace prelight::viewer {

InstantRadiosityLighting::InstantRadiosityLighting(const VirtualLightSet& set, const CompiledScene& compiled,
                                                   const RenderScene& scene)
    : ShadowedLighting(compiled, scene) {
  updateLights(set);
}

void InstantRadiosityLighting::updateLights(const VirtualLightSet& set) {
  maps_.set(set);
  renewals_ = set.renewals;
}

void InstantRadiosityLighting::light(const Illumination& light) {
  ShadowedLighting::light(light);
  maps_.update(scene(), compiled(), paced_ && renewals_ > 0 ? renewals_ : VirtualLightMaps::everything);
}

void InstantRadiosityLighting::bind(const gl::Program& program) const {
  ShadowedLighting::bind(program);
  maps_.bind(program);
}

void InstantRadiosityLighting::sceneMoved() {
  ShadowedLighting::sceneMoved();
  maps_.sceneMoved();
}

bool InstantRadiosityLighting::isBehind() const { return ShadowedLighting::isBehind() || maps_.isBehind(); }

}  // namespace prelight::viewer
