#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "scene/animation.h"
#include "scene/gltf/load/load_parts.h"

namespace prelight {

namespace {

struct PointerName {
  std::string_view suffix;
  AnimatedProperty property;
  bool isFactor = false;
};

constexpr auto materialPointers = std::to_array<PointerName>({
    {"pbrMetallicRoughness/baseColorFactor", AnimatedProperty::BaseColor},
    {"pbrMetallicRoughness/metallicFactor", AnimatedProperty::Metallic},
    {"pbrMetallicRoughness/roughnessFactor", AnimatedProperty::Roughness},
    {"emissiveFactor", AnimatedProperty::Emission},
    {"extensions/KHR_materials_emissive_strength/emissiveStrength", AnimatedProperty::Emission, true},
    {"alphaCutoff", AnimatedProperty::AlphaCutoff},
    {"normalTexture/scale", AnimatedProperty::NormalScale},
    {"extensions/KHR_materials_transmission/transmissionFactor", AnimatedProperty::Transmission},
    {"extensions/KHR_materials_volume/thicknessFactor", AnimatedProperty::Thickness},
    {"extensions/KHR_materials_volume/attenuationColor", AnimatedProperty::AttenuationColor},
    {"extensions/KHR_materials_volume/attenuationDistance", AnimatedProperty::AttenuationDistance},
    {"extensions/KHR_materials_ior/ior", AnimatedProperty::Ior},
    {"extensions/KHR_materials_specular/specularFactor", AnimatedProperty::Specular},
    {"extensions/KHR_materials_specular/specularColorFactor", AnimatedProperty::SpecularColor},
    {"extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor",
     AnimatedProperty::DiffuseTransmission},
    {"extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor",
     AnimatedProperty::DiffuseTransmissionColor},
    {"extensions/KHR_materials_clearcoat/clearcoatFactor", AnimatedProperty::Clearcoat},
    {"extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", AnimatedProperty::ClearcoatRoughness},
    {"extensions/KHR_materials_sheen/sheenColorFactor", AnimatedProperty::SheenColor},
    {"extensions/KHR_materials_sheen/sheenRoughnessFactor", AnimatedProperty::SheenRoughness},
});

constexpr auto lightPointers = std::to_array<PointerName>({
    {"color", AnimatedProperty::LightIntensity},
    {"intensity", AnimatedProperty::LightIntensity, true},
    {"range", AnimatedProperty::LightRange},
    {"spot/innerConeAngle", AnimatedProperty::InnerConeAngle},
    {"spot/outerConeAngle", AnimatedProperty::OuterConeAngle},
});

constexpr auto cameraPointers = std::to_array<PointerName>({
    {"perspective/yfov", AnimatedProperty::YFov},
    {"orthographic/xmag", AnimatedProperty::XMag},
    {"orthographic/ymag", AnimatedProperty::YMag},
});

/// An element of a file's array, and the part of it to which a pointer leads.
struct PointedElement {
  std::size_t index = 0;
  std::string_view rest;
};

/// Returns nullopt where the pointer does not lead into one of the array's elements.
std::optional<PointedElement> elementOf(std::string_view pointer, std::string_view array) {
  if (!pointer.starts_with(array)) return std::nullopt;
  pointer.remove_prefix(array.size());
  PointedElement element;
  const char* end = pointer.data() + pointer.size();
  const auto [stop, error] = std::from_chars(pointer.data(), end, element.index);
  if (error != std::errc{} || stop == end || *stop != '/') return std::nullopt;
  element.rest = pointer.substr(static_cast<std::size_t>(stop - pointer.data()) + 1);
  return element;
}

const PointerName* nameOf(std::span<const PointerName> names, std::string_view rest) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.suffix == rest; });
  return found == names.end() ? nullptr : &*found;
}

glm::vec4 vectorOr(const JsonCursor& object, const char* name, float fallback) {
  glm::vec4 value(fallback);
  const auto json = object.find(name);
  for (std::size_t i = 0; json && i < std::min<std::size_t>(json->arraySize(), 4); ++i)
    value[static_cast<int>(i)] = finiteFloat(json->at(i));
  return value;
}

glm::vec4 numberOr(const JsonCursor& object, const char* name, float fallback) {
  const auto json = object.find(name);
  return glm::vec4(json ? finiteFloat(*json) : fallback);
}

AnimationTarget propertyTarget(const PointerName& name, std::string text) {
  AnimationTarget target;
  target.text = std::move(text);
  target.property = name.property;
  target.isFactor = name.isFactor;
  return target;
}

AnimationTarget materialTarget(const LoadContext& context, const PointerName& name, std::size_t index,
                               std::string text) {
  AnimationTarget target = propertyTarget(name, std::move(text));
  target.objects = {index};
  if (name.property != AnimatedProperty::Emission) return target;
  const JsonCursor material = context.root.at("materials").at(index);
  const auto strength = LoadContext::extension(material, "KHR_materials_emissive_strength");
  if (name.isFactor)
    target.other = vectorOr(material, "emissiveFactor", 0.0f);
  else if (strength)
    target.other = numberOr(*strength, "emissiveStrength", 1.0f);
  return target;
}

std::size_t countLightsOf(const LoadContext& context) {
  const auto punctual = LoadContext::extension(context.root, "KHR_lights_punctual");
  return punctual ? punctual->countOf("lights") : 0;
}

}  // namespace

std::optional<AnimatedPath> animatedPath(std::string_view name) {
  if (name == "translation") return AnimatedPath::Translation;
  if (name == "rotation") return AnimatedPath::Rotation;
  if (name == "scale") return AnimatedPath::Scale;
  if (name == "weights") return AnimatedPath::Weights;
  return std::nullopt;
}

PointerFinder::PointerFinder(const LoadContext& context, const Scene& scene)
    : context_(context), scene_(scene) {
  const auto nodeOf = [&](std::size_t sceneNode) {
    return context.root.at("nodes").at(static_cast<std::size_t>(scene.nodes[sceneNode].node));
  };
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (const auto light = LoadContext::extension(nodeOf(scene.lights[i].sceneNode), "KHR_lights_punctual");
        light && scene.lights[i].profile == nullptr)
      lights_[light->at("light").asUnsigned()].push_back(i);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    cameras_[nodeOf(scene.cameras[i].sceneNode).at("camera").asUnsigned()].push_back(i);
}

AnimationTarget PointerFinder::lightTarget(AnimationTarget target, std::size_t light) const {
  if (const auto found = lights_.find(light); found != lights_.end()) target.objects = found->second;
  if (*target.property != AnimatedProperty::LightIntensity) return target;
  const JsonCursor json =
      LoadContext::extension(context_.root, "KHR_lights_punctual")->at("lights").at(light);
  target.other = target.isFactor ? vectorOr(json, "color", 1.0f) : numberOr(json, "intensity", 1.0f);
  return target;
}

std::optional<AnimationTarget> PointerFinder::find(const JsonCursor& pointer) const {
  const std::string& text = pointer.asString();
  const auto checked = [&](std::size_t index, std::size_t count) {
    if (index >= count) pointer.fail(fmt::format("\"{}\" leads to nothing in this file", text));
    return index;
  };
  if (const auto node = elementOf(text, "/nodes/")) {
    AnimationTarget target;
    target.text = text;
    target.path = animatedPath(node->rest);
    if (!target.path) return std::nullopt;
    target.node = checked(node->index, context_.root.countOf("nodes"));
    return target;
  }
  if (const auto material = elementOf(text, "/materials/")) {
    const PointerName* name = nameOf(materialPointers, material->rest);
    if (name == nullptr) return std::nullopt;
    return materialTarget(context_, *name, checked(material->index, scene_.materials.size()), text);
  }
  if (const auto light = elementOf(text, "/extensions/KHR_lights_punctual/lights/")) {
    const PointerName* name = nameOf(lightPointers, light->rest);
    if (name == nullptr) return std::nullopt;
    return lightTarget(propertyTarget(*name, text), checked(light->index, countLightsOf(context_)));
  }
  if (const auto camera = elementOf(text, "/cameras/")) {
    const PointerName* name = nameOf(cameraPointers, camera->rest);
    if (name == nullptr) return std::nullopt;
    AnimationTarget target = propertyTarget(*name, text);
    const auto found = cameras_.find(checked(camera->index, context_.root.countOf("cameras")));
    if (found != cameras_.end()) target.objects = found->second;
    return target;
  }
  return std::nullopt;
}

}  // namespace prelight
