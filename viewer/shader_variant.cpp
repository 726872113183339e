#include "viewer/shader_variant.h"

#include <algorithm>
#include <array>

#include "scene/lobes.h"
#include "viewer/render_scene.h"

namespace prelight::viewer {
namespace {

/// In the order of Feature.
constexpr std::array<const char*, featureCount> names = {"hasBaseColorTexture",
                                                         "hasMetallicRoughnessTexture",
                                                         "hasEmissiveTexture",
                                                         "hasNormalTexture",
                                                         "hasTransmissionTexture",
                                                         "hasSpecularTextures",
                                                         "hasEmission",
                                                         "hasCutouts",
                                                         "hasBlending",
                                                         "hasUnlit",
                                                         "hasTranslucency",
                                                         "hasGloss",
                                                         "hasGlass",
                                                         "hasRoughGlass",
                                                         "hasLayer",
                                                         "hasTopLayers",
                                                         "hasLayerTextures",
                                                         "hasAnisotropy",
                                                         "hasFilm",
                                                         "hasDispersion",
                                                         "hasSurroundings",
                                                         "hasMeasured",
                                                         "hasVertexColors",
                                                         "hasCharts",
                                                         "hasCaustics",
                                                         "hasSkyLight",
                                                         "hasSkyMap",
                                                         "hasDirectionalLights",
                                                         "hasPointLights",
                                                         "hasSpotLights",
                                                         "hasProfiledLights",
                                                         "hasEmitterLights",
                                                         "hasCookieLights",
                                                         "hasAreaLights",
                                                         "hasNearLamps"};

std::string constant(const char* type, const char* name, const std::string& value) {
  return std::string("const ") + type + " " + name + " = " + value + ";\n";
}

std::string constant(const char* name, bool value) {
  return constant("bool", name, value ? "true" : "false");
}

/// As mirrorShare() in surface.frag; textures only take away.
bool hasMirrorLayer(const Material& m) {
  constexpr float leastMirror = 0.2f;
  const float ratio = m.ior > 0.0f ? (m.ior - 1.0f) / (m.ior + 1.0f) : 1.0f;
  const glm::vec3& color = m.specularColor;
  return m.specular * std::min(ratio * ratio * std::max({color.r, color.g, color.b}), 1.0f) > leastMirror;
}

}  // namespace

const char* nameOf(Feature feature) { return names[static_cast<std::size_t>(feature)]; }

std::string textOf(const ShaderVariant& variant) {
  const DrawingRules& rules = variant.rules;
  std::string text = constant("int", "ambientRule", std::to_string(static_cast<int>(rules.ambient))) +
                     constant("int", "reflectionRule", std::to_string(static_cast<int>(rules.reflection))) +
                     constant("int", "throughRule", std::to_string(static_cast<int>(rules.through))) +
                     constant("int", "lampCount", std::to_string(variant.lights.lamps)) +
                     constant("int", "sampleCount", std::to_string(variant.lights.samples)) +
                     constant("int", "aoCorrection", std::to_string(variant.aoCorrection)) +
                     constant("int", "aoFilter", std::to_string(variant.aoFilter)) +
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
  features.add(Feature::Gloss, m.metallic > 0.0f || glass || hasMirrorLayer(m));
  features.add(Feature::Glass, glass);
  features.add(Feature::RoughGlass, glass && m.roughness >= smoothBelow);
  features.add(Feature::Layer, m.specular > 0.0f);
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

}  // namespace prelight::viewer
