#include "viewer/programs/shader_variant.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "scene/lobes.h"
#include "viewer/scene/render_scene.h"

namespace prelight::viewer {
namespace {

constexpr Features reflectingFeatures = {Feature::Gloss, Feature::Layer, Feature::FurtherLobes};

/// Textures and emission are read once a pixel; one kind of reflection costs as much as another.
constexpr Features cheapFeatures =
    Features{Feature::BaseColorTexture, Feature::MetallicRoughnessTexture, Feature::EmissiveTexture,
             Feature::NormalTexture,    Feature::SpecularTextures,         Feature::Emission} |
    reflectingFeatures;

struct NamedFeature {
  Feature feature = Feature::BaseColorTexture;
  std::string_view name;
};

constexpr std::array<NamedFeature, featureCount> featureNames = {{
    {Feature::BaseColorTexture, "hasBaseColorTexture"},
    {Feature::MetallicRoughnessTexture, "hasMetallicRoughnessTexture"},
    {Feature::EmissiveTexture, "hasEmissiveTexture"},
    {Feature::NormalTexture, "hasNormalTexture"},
    {Feature::TransmissionTexture, "hasTransmissionTexture"},
    {Feature::SpecularTextures, "hasSpecularTextures"},
    {Feature::Emission, "hasEmission"},
    {Feature::Cutouts, "hasCutouts"},
    {Feature::Blending, "hasBlending"},
    {Feature::Unlit, "hasUnlit"},
    {Feature::Translucency, "hasTranslucency"},
    {Feature::Gloss, "hasGloss"},
    {Feature::Glass, "hasGlass"},
    {Feature::RoughGlass, "hasRoughGlass"},
    {Feature::Layer, "hasLayer"},
    {Feature::FurtherLobes, "hasFurtherLobes"},
    {Feature::TopLayers, "hasTopLayers"},
    {Feature::LayerTextures, "hasLayerTextures"},
    {Feature::Anisotropy, "hasAnisotropy"},
    {Feature::Film, "hasFilm"},
    {Feature::Dispersion, "hasDispersion"},
    {Feature::Surroundings, "hasSurroundings"},
    {Feature::LocalReflections, "hasLocalReflections"},
    {Feature::Measured, "hasMeasured"},
    {Feature::VertexColors, "hasVertexColors"},
    {Feature::Charts, "hasCharts"},
    {Feature::Caustics, "hasCaustics"},
    {Feature::SkyLight, "hasSkyLight"},
    {Feature::SkyMap, "hasSkyMap"},
    {Feature::DirectionalLights, "hasDirectionalLights"},
    {Feature::PointLights, "hasPointLights"},
    {Feature::SpotLights, "hasSpotLights"},
    {Feature::ProfiledLights, "hasProfiledLights"},
    {Feature::EmitterLights, "hasEmitterLights"},
    {Feature::CookieLights, "hasCookieLights"},
    {Feature::AreaLights, "hasAreaLights"},
    {Feature::NearLamps, "hasNearLamps"},
    {Feature::ShadowMaps, "hasShadowMaps"},
}};
static_assert(followsOrder(featureNames, &NamedFeature::feature));

std::string constant(std::string_view name, int value) {
  return "const int " + std::string(name) + " = " + std::to_string(value) + ";\n";
}

std::string constant(std::string_view name, bool value) {
  return "const bool " + std::string(name) + " = " + (value ? "true" : "false") + ";\n";
}

/// Constants for all values of an enumeration.
template <typename Rule>
std::string constantsOf(std::string_view (*nameOfRule)(Rule)) {
  std::string text;
  for (std::size_t i = 0; i < countNamed(nameOfRule); ++i)
    text += constant(nameOfRule(static_cast<Rule>(i)), static_cast<int>(i));
  return text;
}

/// Whether anything but metalness and roughness says how a material reflects.
bool hasFurtherLobes(const Material& m) {
  constexpr float plainIor = 1.5f;
  const bool plainLayer =
      m.specular == 0.0f || (m.ior == plainIor && m.specular == 1.0f && m.specularColor == glm::vec3(1.0f));
  return !plainLayer || m.specularTexture.image >= 0 || m.specularColorTexture.image >= 0 ||
         m.clearcoat.factor > 0.0f || m.sheen.color != glm::vec3(0.0f) || m.anisotropy.strength > 0.0f ||
         m.iridescence.factor > 0.0f || m.transmission > 0.0f;
}

}  // namespace

std::string_view nameOf(Feature feature) { return featureNames[static_cast<std::size_t>(feature)].name; }

ShaderVariant variantOfAnySurface() {
  ShaderVariant variant;
  variant.features = Features::all();
  return variant;
}

std::string textOf(const ShaderVariant& variant) {
  const DrawingRules& rules = variant.rules;
  std::string text = constantsOf<Reflection>(nameOf) + constantsOf<Through>(nameOf) +
                     constant("reflectionRule", static_cast<int>(rules.reflection)) +
                     constant("throughRule", static_cast<int>(rules.through)) +
                     constant("lampCount", variant.lights.lamps) +
                     constant("sampleCount", variant.lights.samples) +
                     constant("aoCorrection", variant.aoCorrection) + constant("aoFilter", variant.aoFilter) +
                     constant("phongLobe", variant.phongLobe) + constant("showsParts", variant.showsParts);
  for (int i = 0; i < featureCount; ++i)
    text += constant(nameOf(static_cast<Feature>(i)), variant.features.has(static_cast<Feature>(i)));
  return text;
}

LightCounts fewLights(std::span<const ShadedLight> lights) {
  const auto samples = std::count_if(lights.begin(), lights.end(), [](const auto& l) { return l.isSample; });
  const auto lamps = static_cast<std::ptrdiff_t>(lights.size()) - samples;
  LightCounts counts;
  if (lamps > LightCounts::mostLamps) return counts;
  counts.lamps = static_cast<int>(lamps);
  if (samples <= LightCounts::mostSamples) counts.samples = static_cast<int>(samples);
  return counts;
}

Features featuresOf(const Surface& surface) {
  const Material& m = surface.material;
  const bool glass = m.transmission > 0.0f;
  Features features;
  features.add(Feature::BaseColorTexture, surface.has(TextureSlot::BaseColor));
  features.add(Feature::MetallicRoughnessTexture, surface.has(TextureSlot::MetallicRoughness));
  features.add(Feature::EmissiveTexture, surface.has(TextureSlot::Emissive));
  features.add(Feature::NormalTexture, surface.has(TextureSlot::Normal));
  features.add(Feature::TransmissionTexture, surface.has(TextureSlot::Transmission));
  features.add(Feature::SpecularTextures,
               surface.has(TextureSlot::Specular) || surface.has(TextureSlot::SpecularColor));
  features.add(Feature::Emission, std::max({m.emission.r, m.emission.g, m.emission.b}) > 0.0f);
  features.add(Feature::Cutouts, m.alphaMode == AlphaMode::Mask);
  features.add(Feature::Blending, surface.isBlended());
  features.add(Feature::Unlit, m.unlit);
  features.add(Feature::Translucency, surface.translucency.a > 0.0f);
  features.add(Feature::Gloss, m.metallic > 0.0f || hasFurtherLobes(m));
  features.add(Feature::Glass, glass);
  features.add(Feature::RoughGlass, glass && m.roughness >= smoothBelow);
  features.add(Feature::Layer, m.specular > 0.0f);
  features.add(Feature::FurtherLobes, hasFurtherLobes(m));
  features.add(Feature::TopLayers, m.clearcoat.factor > 0.0f || m.sheen.color != glm::vec3(0.0f));
  features.add(Feature::LayerTextures,
               surface.has(TextureSlot::Coat) || surface.has(TextureSlot::CoatRoughness) ||
                   surface.has(TextureSlot::CoatNormal) || surface.has(TextureSlot::SheenColor) ||
                   surface.has(TextureSlot::SheenRoughness));
  features.add(Feature::Anisotropy, m.anisotropy.strength > 0.0f);
  features.add(Feature::Film, m.iridescence.factor > 0.0f && m.iridescence.thicknessMaximum > 0.0f);
  features.add(Feature::Dispersion, glass && m.dispersion > 0.0f && m.thickness > 0.0f && m.ior > 0.0f);
  features.add(Feature::Surroundings, surface.showsSurroundings);
  features.add(Feature::Measured, surface.measured >= 0);
  return features;
}

std::vector<Features> sharedFeatures(std::span<const Features> surfaces) {
  const auto kindOf = [](Features features) {
    return std::pair(features & ~cheapFeatures, (features & reflectingFeatures) != Features());
  };
  std::map<std::pair<Features, bool>, Features> shared;
  for (const Features features : surfaces) {
    Features& ofKind = shared[kindOf(features)];
    ofKind = ofKind | features;
  }
  std::vector<Features> result;
  for (const Features features : surfaces) result.push_back(shared[kindOf(features)]);
  return result;
}

}  // namespace prelight::viewer
