#include "viewer/lights/view_lights.h"

#include <algorithm>

#include <numbers>
#include <utility>
#include "scene/light_sources.h"

#include "base/colour.h"
#include "scene/light_profile.h"

namespace prelight::viewer {
namespace {

/// Number of samples in drafts for each primitive that glows, up to emitterSamples for all.
constexpr int draftSamplesOfPrimitive = 4;

/// Number of samples that represent an area light where there is no closed form.
constexpr int areaSamples = 16;

/// Strength by which lights are chosen where there are too many.
float strengthOf(const ShadedLight& light) {
  const float sum = light.intensity.r + light.intensity.g + light.intensity.b;
  if (light.kind == LightKind::Area) return sum * light.area;
  if (light.cookie != nullptr) return sum * static_cast<float>(luminance(cookieMean(*light.cookie)));
  if (light.profile == nullptr) return sum;
  return sum * static_cast<float>(profilePower(*light.profile) / (4.0 * std::numbers::pi));
}

int glowingPrimitives(const CompiledScene& scene) {
  const std::vector<Emitter> emitters = emittersOf(scene);  // by ascending triangle
  const auto glows = [&](const PrimitiveRange& range) {
    const auto first = std::ranges::lower_bound(emitters, range.firstTriangle, {}, &Emitter::triangle);
    return first != emitters.end() && first->triangle - range.firstTriangle < range.triangleCount;
  };
  return static_cast<int>(std::ranges::count_if(scene.primitives, glows));
}

void replaceByTheirSamples(std::vector<ShadedLight>& lights) {
  std::vector<ShadedLight> parts;
  for (const ShadedLight& light : lights)
    if (light.kind == LightKind::Area)
      for (const ShadedLight& sample : samplesOf(light, areaSamples)) parts.push_back(sample);
  std::erase_if(lights, [](const ShadedLight& light) { return light.kind == LightKind::Area; });
  lights.insert(lights.end(), parts.begin(), parts.end());
}

}  // namespace

ViewLights::ViewLights(const CompiledScene& scene) : scene_(&scene), bodies_(glowingBodies(scene)) {
  sample();
}

std::vector<ShadedLight> ViewLights::shaded(std::span<const Light> lights) {
  std::vector<ShadedLight> result;
  for (const Light& light : lights) result.push_back(shadedLight(light, *scene_));
  tables_.set(lights, result);
  return result;
}

void ViewLights::setScene(const CompiledScene& scene) {
  scene_ = &scene;
  sample();
  if (samples_ != nullptr) samples_->setScene(scene);
}

void ViewLights::sample() {
  emitters_ = sampleEmitters(*scene_, bodies_, emitterSamples);
  const int fewer = std::min(draftSamplesOfPrimitive * glowingPrimitives(*scene_), emitterSamples);
  draftEmitters_ = sampleEmitters(*scene_, bodies_, fewer);
}

void ViewLights::thinOut(std::vector<ShadedLight>& lights) const {
  std::erase_if(lights, [](const ShadedLight& source) { return source.isSample; });
  lights.insert(lights.end(), draftEmitters_.begin(), draftEmitters_.end());
}

std::vector<ShadedLight> ViewLights::of(const View& view, const SeenSky& sky) {
  std::vector<ShadedLight> lights = shaded(view.lights), samples;
  if (infoOf(view.shading).traits.areaLightsAsSamples) replaceByTheirSamples(lights);
  if (showsAllLight(view.shading)) {
    if (samples_ == nullptr) samples_ = std::make_unique<LightSamples>(*scene_, bodies_);
    samples = samples_->of(view.emitters, sky.map, view.skyRotation);
  } else if (view.emitters) {
    samples = emitters_;
  }
  std::vector<ShadedLight> ofSky;
  for (const SkyLamp& lamp : sky.lamps) ofSky.push_back(lightOf(lamp, view.skyRotation));
  samples.insert(samples.begin(), ofSky.begin(), ofSky.end());
  const std::size_t room = maxLights - samples.size();
  if (lights.size() > room) {
    std::vector<std::pair<float, std::size_t>> order;
    for (std::size_t i = 0; i < lights.size(); ++i) order.emplace_back(-strengthOf(lights[i]), i);
    std::sort(order.begin(), order.end());
    std::vector<ShadedLight> strongest;
    for (std::size_t i = 0; i < room; ++i) strongest.push_back(lights[order[i].second]);
    lights = std::move(strongest);
  }
  lights.insert(lights.end(), samples.begin(), samples.end());
  return lights;
}

}  // namespace prelight::viewer
