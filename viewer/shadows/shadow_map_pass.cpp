#include "viewer/shadows/shadow_map_pass.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/directions.h"

namespace prelight::viewer {
namespace {

constexpr std::size_t mostCasters = maxLights;  ///< as many as shadows.glsl has room for
constexpr int partsOfALamp = 8;                 ///< of one whose size shows
constexpr float leastShownRadius =
    0.026f;  ///< 1.5 degrees, half the angle of a lamp whose shadows are seen to be soft

/// Triangles that all maps of samples together may draw.
constexpr std::size_t mostTrianglesOfSamples = std::size_t{1} << 25;
constexpr std::size_t viewsOfASample = 5;
constexpr std::size_t leastSamples = 4;

/// Parts of a directional lamp: directions within its disk, evenly by area.
std::vector<ShadedLight> partsOfDisk(const ShadedLight& light) {
  std::vector<ShadedLight> parts(partsOfALamp, light);
  const double depth = 1.0 - std::cos(double{light.radius});
  for (int i = 0; i < partsOfALamp; ++i)
    parts[static_cast<std::size_t>(i)].direction =
        directionAbout(light.direction, 1.0 - depth * (i + 0.5) / partsOfALamp, i);
  return parts;
}

/// Parts of a ball: places on a shell within it, evenly by area.
std::vector<ShadedLight> partsOfBall(const ShadedLight& light) {
  // From one side a ball looks as wide as a disk whose mean square radius is half of its own: so does this
  // shell.
  constexpr float share = 0.8660254f;
  std::vector<ShadedLight> parts;
  for (const glm::dvec3& direction : spiralDirections(partsOfALamp)) {
    parts.push_back(light);
    parts.back().position += share * light.radius * glm::vec3(direction);
  }
  return parts;
}

std::vector<ShadedLight> partsOf(const ShadedLight& light) {
  if (light.kind == LightKind::Area) return samplesOf(light, partsOfALamp);
  if (light.kind == LightKind::Directional && light.radius >= leastShownRadius) return partsOfDisk(light);
  const bool isBall = light.kind == LightKind::Point || light.kind == LightKind::Spot;
  return isBall && light.radius > 0.0f ? partsOfBall(light) : std::vector<ShadedLight>{light};
}

/// How many samples of emissive surfaces have maps of their own.
std::size_t mappedSamples(std::size_t samples, std::size_t triangles) {
  const std::size_t affordable =
      mostTrianglesOfSamples / (viewsOfASample * std::max<std::size_t>(triangles, 1));
  return std::min(samples, std::max(affordable, leastSamples));
}

}  // namespace

void ShadowMapPass::give(ShadedLight& light, std::vector<ShadedLight> parts) {
  light.firstMap = static_cast<int>(casters_.size());
  light.maps = static_cast<int>(parts.size());
  casters_.insert(casters_.end(), parts.begin(), parts.end());
}

/// Lamps come first, which have a map for all of their parts, or one where there is no room for all.
void ShadowMapPass::shadow(const View& view, std::vector<ShadedLight>& lights) {
  casters_.clear();
  const ShadingInfo& info = infoOf(view.shading);
  if (view.direct == LampShadows::Baked || (view.direct == LampShadows::Auto && info.traits.shadowsOfItsOwn))
    return;
  std::vector<ShadedLight*> samples;
  for (ShadedLight& light : lights) {
    if (view.direct == LampShadows::Maps && info.rules.through == Through::FarLights)
      light.throughTransfer = false;
    if (light.isSample) {
      samples.push_back(&light);
      continue;
    }
    if (light.ofSky && comesThrough(info.rules.through, light)) continue;  // lobes reflect it with the sky
    std::vector<ShadedLight> parts = partsOf(light);
    if (casters_.size() + parts.size() > mostCasters) parts.resize(1);
    if (casters_.size() < mostCasters) give(light, std::move(parts));
  }
  const std::size_t room = std::min<std::size_t>(mostCasters - casters_.size(), samples.size());
  const std::size_t mapped = std::min(room, mappedSamples(samples.size(), compiled_.triangleCount()));
  std::vector<ShadedLight> chosen;
  for (std::size_t i = 0; i < mapped; ++i) {
    ShadedLight& sample = *samples[i * samples.size() / mapped];
    give(sample, {sample});
    chosen.push_back(sample);
  }
  for (ShadedLight* sample : samples)
    if (sample->firstMap < 0) shadowSamples(chosen, std::span(sample, 1));
}

void ShadowMapPass::shadowSamples(std::span<const ShadedLight> lights, std::span<ShadedLight> samples) const {
  for (ShadedLight& sample : samples) {
    if (!sample.isSample || sample.firstMap >= 0) continue;
    const ShadedLight* nearest =
        nearestSample(lights, sample.position, [](const ShadedLight& other) { return other.firstMap >= 0; });
    if (nearest == nullptr) continue;
    sample.firstMap = nearest->firstMap;
    sample.maps = nearest->maps;
  }
}

void ShadowMapPass::prepare(const PictureState& picture, SceneDrawer&) {
  if (casters_.empty()) return;
  const std::size_t most = picture.pace.spread ? ShadowMaps::sampleViewsAPicture : ShadowMaps::everything;
  maps_.update(scene_, compiled_, casters_, moved_, {most, picture.view.draft});
  moved_ = false;
  picture.passed({FramePass::ShadowMaps, maps_.viewsDrawn(), maps_.texelsDrawn()});
}

void ShadowMapPass::addFeatures(Features& features) const {
  features.add(Feature::ShadowMaps, !casters_.empty());
}

void ShadowMapPass::bindTextures() const {
  if (!casters_.empty()) maps_.bind();
}

void ShadowMapPass::addPlan(std::vector<PlannedPass>& plan) const {
  if (casters_.empty()) return;
  plan.push_back(
      {Pass::ShadowMaps, true,
       "lamps and samples of emissive surfaces have " + std::to_string(casters_.size()) + " of them"});
}

extern const PassRow shadowMapRow = {
    .isIn = [](Shading shading, const RenderInputs&) { return !showsAllLight(shading); },
    .make = [](const TechniqueInputs& of) -> std::unique_ptr<TechniquePass> {
      return std::make_unique<ShadowMapPass>(of.inputs.compiled, of.scene);
    },
};

}  // namespace prelight::viewer
