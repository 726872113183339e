#include "viewer/lights/light_samples.h"

#include <utility>

namespace prelight::viewer {

LightSamples::LightSamples(const CompiledScene& scene, std::vector<BodySide> bodies)
    : bodies_(std::move(bodies)) {
  setScene(scene);
}

void LightSamples::setScene(const CompiledScene& scene) {
  emitters_ = sampleEmitters(scene, bodies_, emitterCount);
}

std::vector<ShadedLight> LightSamples::of(bool emitters, const Environment* sky, double rotation) {
  std::vector<ShadedLight> samples;
  if (emitters) samples = emitters_;
  if (sky == nullptr) return samples;
  if (cutSky_ != sky) {
    skyLights_ = medianCut(*sky, skyCount);
    cutSky_ = sky;
  }
  const glm::dmat3 turn = skyTurn(rotation);
  for (const SkyLight& part : skyLights_) {
    ShadedLight sample;
    sample.kind = LightKind::Directional;
    sample.direction = glm::vec3(-(turn * part.direction));
    sample.intensity = glm::vec3(part.irradiance);
    sample.throughTransfer = true;
    sample.isSample = true;
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace prelight::viewer
