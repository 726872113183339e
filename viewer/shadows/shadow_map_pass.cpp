#include "viewer/shadows/shadow_map_pass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

namespace prelight::viewer {
namespace {

constexpr std::size_t mostCasters = maxLights;  ///< as many as shadows.glsl has room for
constexpr int partsOfALamp = 8;                 ///< of one whose size shows
constexpr float leastShownRadius =
    0.026f;  ///< 1.5 degrees, half the angle of a lamp whose shadows are seen to be soft
constexpr float spreadOfParts = 2.3999632f;  ///< the golden angle, rad

/// Triangles that all maps of samples together may draw.
constexpr std::size_t mostTrianglesOfSamples = std::size_t{1} << 25;
constexpr std::size_t viewsOfASample = 5;
constexpr std::size_t leastSamples = 4;

bool throughDiffuseTransfer(const DrawingRules& rules, const ShadedLight& light) {
  return rules.through == Through::AllLights ||
         (rules.through == Through::FarLights && light.throughTransfer);
}

/// Two unit vectors that are perpendicular to a third one and to one another.
std::pair<glm::vec3, glm::vec3> across(const glm::vec3& axis) {
  const glm::vec3 side = std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(side, axis));
  return {x, glm::cross(axis, x)};
}

/// Parts of a directional lamp: directions within its disk, evenly by area (Vogel's spiral).
std::vector<ShadedLight> partsOfDisk(const ShadedLight& light) {
  const auto [x, y] = across(light.direction);
  std::vector<ShadedLight> parts(partsOfALamp, light);
  for (int i = 0; i < partsOfALamp; ++i) {
    const float turn = spreadOfParts * static_cast<float>(i);
    const float radius = std::tan(light.radius) * std::sqrt((static_cast<float>(i) + 0.5f) / partsOfALamp);
    parts[static_cast<std::size_t>(i)].direction =
        glm::normalize(light.direction + radius * (std::cos(turn) * x + std::sin(turn) * y));
  }
  return parts;
}

/// Parts of a ball: places on it, evenly by area (a spherical Fibonacci lattice).
std::vector<ShadedLight> partsOfBall(const ShadedLight& light) {
  std::vector<ShadedLight> parts(partsOfALamp, light);
  for (int i = 0; i < partsOfALamp; ++i) {
    const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / partsOfALamp;
    const float turn = spreadOfParts * static_cast<float>(i), across = std::sqrt(1.0f - z * z);
    // What is seen of a ball from one side is as wide as a disk whose mean square radius is half of its own:
    // so is that of this shell.
    constexpr float share = 0.8660254f;
    parts[static_cast<std::size_t>(i)].position +=
        share * light.radius * glm::vec3(across * std::cos(turn), across * std::sin(turn), z);
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
    if (light.ofSky && throughDiffuseTransfer(info.rules, light)) continue;  // lobes reflect it with the sky
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
    float least = std::numeric_limits<float>::infinity();
    for (const ShadedLight& other : lights) {
      const float distance = glm::distance(other.position, sample.position);
      if (!other.isSample || other.firstMap < 0 || distance >= least) continue;
      least = distance;
      sample.firstMap = other.firstMap;
      sample.maps = other.maps;
    }
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
