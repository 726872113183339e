#include "viewer/view_lights.h"

#include <algorithm>
#include <numbers>

namespace prelight::viewer {
namespace {

constexpr int draftEmitterSamples = 4;

/// W/sr over all directions.
float meanOf(const LightProfile& profile) {
  return static_cast<float>(profilePower(profile) / (4.0 * std::numbers::pi));
}

}  // namespace

ViewLights::ViewLights(const CompiledScene& scene) : scene_(&scene), bodies_(glowingBodies(scene)) {
  sample();
  for (const Light& light : scene.lights)
    if (light.profile != nullptr) {
      profiles_.add(light);
      if (!means_.contains(light.profile.get())) means_[light.profile.get()] = meanOf(*light.profile);
    }
}

/// A profile that is not the scene's counts with its mean.
ShadedLight ViewLights::shaded(const Light& light) const {
  ShadedLight result = shadedLight(light, *scene_);
  if (light.profile == nullptr) return result;
  if (const auto entry = profiles_.entryOf(light)) {
    result.profileEntry = *entry;
    return result;
  }
  result.kind = LightKind::Point;
  result.intensity *= meanOf(*light.profile);
  result.profile = nullptr;
  return result;
}

void ViewLights::setScene(const CompiledScene& scene) {
  scene_ = &scene;
  sample();
  if (samples_ != nullptr) samples_->setScene(scene);
}

/// Drafts have fewer samples, but not fewer than there are triangles to tell apart.
void ViewLights::sample() {
  emitters_ = sampleEmitters(*scene_, bodies_, emitterSamples);
  const auto triangles = std::count_if(scene_->triangleMaterials.begin(), scene_->triangleMaterials.end(),
                                       [&](std::uint32_t material) {
                                         const glm::vec3& emission = scene_->materials[material].emission;
                                         return std::max({emission.r, emission.g, emission.b}) > 0.0f;
                                       });
  const auto fewer = std::clamp<std::ptrdiff_t>(triangles, draftEmitterSamples, emitterSamples);
  draftEmitters_ = sampleEmitters(*scene_, bodies_, static_cast<int>(fewer));
}

void ViewLights::thinOut(std::vector<ShadedLight>& lights) const {
  std::erase_if(lights, [](const ShadedLight& source) { return source.isSample; });
  lights.insert(lights.end(), draftEmitters_.begin(), draftEmitters_.end());
}

std::vector<ShadedLight> ViewLights::of(const View& view, const Environment* sky) {
  std::vector<ShadedLight> lights, samples;
  for (const Light& light : view.lights) lights.push_back(shaded(light));
  if (view.shading == Shading::GlobalIllumination) {
    if (samples_ == nullptr) samples_ = std::make_unique<LightSamples>(*scene_, bodies_);
    samples = samples_->of(view.emitters, sky, view.skyRotation);
  } else if (view.emitters) {
    samples = emitters_;
  }
  const std::size_t room = maxLights - samples.size();
  if (lights.size() > room) {
    const auto strength = [this](const ShadedLight& l) {
      const float sum = l.intensity.r + l.intensity.g + l.intensity.b;
      return l.profile == nullptr ? sum : sum * means_.at(l.profile.get());
    };
    std::stable_sort(lights.begin(), lights.end(),
                     [&](const ShadedLight& a, const ShadedLight& b) { return strength(a) > strength(b); });
    lights.resize(room);
  }
  lights.insert(lights.end(), samples.begin(), samples.end());
  return lights;
}

}  // namespace prelight::viewer
