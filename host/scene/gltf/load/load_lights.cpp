#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/magnitudes.h"
#include "prelight/error.h"
#include "scene/codecs/ies_profile.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/load/load_parts.h"
#include "scene/pose.h"

namespace prelight {

namespace {

constexpr double halfPi = 1.57079632679489662;

float nonNegativeOr(const LoadContext& context, const JsonCursor& object, const char* name, float fallback) {
  const auto number = object.find(name);
  if (!number) return fallback;
  const float value = finiteFloat(*number);
  if (value >= 0.0f) return value;
  context.warnings.push_back(fmt::format("{}: {} is negative; taken as 0", number->where(), value));
  return 0.0f;
}

void warnAboutDirection(const LoadContext& context, int node) {
  context.warn(fmt::format("/nodes/{}", node), "a scale of 0 leaves no direction; the world's axis is taken");
}

void requireNear(const LoadContext& context, int node, const glm::dvec3& position) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(position[axis]) <= largestInput) continue;
    throw InputError(
        context.where(fmt::format("/nodes/{}", node)),
        fmt::format("its light or camera is at ({:g}, {:g}, {:g}) m, expected coordinates within "
                    "{:g} m",
                    position.x, position.y, position.z, largestInput),
        "check the transforms of the node and its ancestors");
  }
}

void loadCone(const LoadContext& context, const JsonCursor& spot, Light& light) {
  light.innerConeAngle = nonNegativeOr(context, spot, "innerConeAngle", 0.0f);
  light.outerConeAngle = nonNegativeOr(context, spot, "outerConeAngle", light.outerConeAngle);
  if (light.outerConeAngle > halfPi) {
    context.warnings.push_back(spot.where() + "/outerConeAngle: beyond pi/2; clamped");
    light.outerConeAngle = static_cast<float>(halfPi);
  }
  if (light.innerConeAngle > light.outerConeAngle) {
    context.warnings.push_back(spot.where() + "/innerConeAngle: beyond outerConeAngle; clamped");
    light.innerConeAngle = light.outerConeAngle;
  }
}

/// Reads a light's size, which files hold in its extras as Blender names it: `radius` in metres or, of a
/// directional light, `angle`, the whole disk's, in radians.
void loadSize(const LoadContext& context, const JsonCursor& source, Light& light) {
  const bool isDisk = light.type == LightType::Directional;
  const char* name = isDisk ? "angle" : "radius";
  const auto extras = source.find("extras");
  if (!extras || !extras->value().is_object()) return;
  const auto size = extras->find(name);
  if (!size || !size->value().is_number()) return;  // extras may hold anything
  light.radius = nonNegativeOr(context, *extras, name, 0.0f);
  if (isDisk) light.radius = std::min(0.5f * light.radius, static_cast<float>(halfPi));
}

}  // namespace

std::optional<Light> loadLight(const LoadContext& context, int node, const glm::dmat4& world) {
  const JsonCursor json = context.root.at("nodes").at(static_cast<std::size_t>(node));
  const auto reference = LoadContext::extension(json, "KHR_lights_punctual");
  if (!reference) return std::nullopt;
  const JsonCursor lights = LoadContext::extension(context.root, "KHR_lights_punctual")->at("lights");
  const JsonCursor source = lights.at(reference->at("light").asUnsigned());

  Light light;
  const std::string type = source.at("type").asString();
  light.type = type == "directional" ? LightType::Directional
               : type == "spot"      ? LightType::Spot
                                     : LightType::Point;
  light.name = source.stringOr("name", json.stringOr("name", ""));
  light.intensity = glm::vec3(nonNegativeOr(context, source, "intensity", 1.0f));
  if (const auto color = source.find("color")) {
    for (int i = 0; i < 3; ++i) {
      const JsonCursor component = color->at(static_cast<std::size_t>(i));
      light.intensity[i] *= std::max(finiteFloat(component), 0.0f);
      if (component.asNumber() < 0.0)
        context.warnings.push_back(component.where() + ": negative; taken as 0");
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (!(light.intensity[i] <= largestInput))
      source.fail(
          fmt::format("colour x intensity is {:g}, expected at most {:g}", light.intensity[i], largestInput),
          "dim the light");
  }
  light.range = nonNegativeOr(context, source, "range", 0.0f);
  if (!placeLight(light, world)) warnAboutDirection(context, node);
  requireNear(context, node, light.position);
  if (light.type == LightType::Spot) loadCone(context, source.at("spot"), light);
  loadSize(context, source, light);
  return light;
}

std::shared_ptr<const LightProfile> ProfileLoader::profileOf(std::size_t index) {
  const JsonCursor json = LoadContext::extension(context_.root, "EXT_lights_ies")->at("lights").at(index);
  const JsonCursor view = context_.root.at("bufferViews").at(json.at("bufferView").asUnsigned());
  const std::uint64_t offset = view.unsignedOr("byteOffset", 0), length = view.at("byteLength").asUnsigned();
  if (length > mostProfileBytes)
    json.fail(fmt::format("the profile has {} bytes, expected at most {}", length, mostProfileBytes));
  const std::vector<std::uint8_t>& bin = context_.document.bin;
  if (view.at("buffer").asUnsigned() != 0 || offset > bin.size() || length > bin.size() - offset)
    json.at("bufferView").fail("the profile's data are missing");
  const auto known = known_.find({offset, length});
  if (known != known_.end()) return known->second;
  take(json, bytes_, length, mostProfilesBytes, "bytes");
  const std::string_view text(reinterpret_cast<const char*>(bin.data()) + offset, length);
  const auto profile = std::make_shared<const LightProfile>(parseIesProfile(text, json.where()));
  take(json, intensities_, profile->values.size(), mostProfilesIntensities, "intensities");
  return known_.emplace(std::pair(offset, length), profile).first->second;
}

void ProfileLoader::take(const JsonCursor& json, std::size_t& taken, std::size_t more, std::size_t most,
                         const char* unit) const {
  taken += more;
  if (taken > most)
    json.fail(fmt::format("the scene's profiles up to this one have {} {}, expected at most {} together",
                          taken, unit, most),
              "use fewer profiles, or ones of fewer angles");
}

std::optional<Light> ProfileLoader::lightOf(int node, const glm::dmat4& world) {
  const JsonCursor json = context_.root.at("nodes").at(static_cast<std::size_t>(node));
  const auto reference = LoadContext::extension(json, "EXT_lights_ies");
  if (!reference) return std::nullopt;
  const std::size_t index = reference->at("light").asUnsigned();
  const JsonCursor source = LoadContext::extension(context_.root, "EXT_lights_ies")->at("lights").at(index);
  Light light;
  light.name = source.stringOr("name", json.stringOr("name", ""));
  light.intensity = glm::vec3(nonNegativeOr(context_, *reference, "multiplier", 1.0f));
  if (const auto color = reference->find("color"))
    for (int i = 0; i < 3; ++i)
      light.intensity[i] *= std::clamp(finiteFloat(color->at(static_cast<std::size_t>(i))), 0.0f, 1.0f);
  light.profile = profileOf(index);
  const double peak = *std::max_element(light.profile->values.begin(), light.profile->values.end());
  const double strongest = peak * std::max({light.intensity.x, light.intensity.y, light.intensity.z});
  if (!(strongest <= largestInput))
    reference->fail(fmt::format("the lamp's strongest intensity is {:g} W/sr, expected at most {:g}",
                                strongest, largestInput),
                    "dim the lamp");
  if (!placeLight(light, world)) warnAboutDirection(context_, node);
  requireNear(context_, node, light.position);
  return light;
}

Camera loadCamera(const LoadContext& context, int node, const glm::dmat4& world) {
  const tinygltf::Node& source = context.model.nodes[static_cast<std::size_t>(node)];
  const JsonCursor json = context.root.at("cameras").at(static_cast<std::size_t>(source.camera));
  Camera camera;
  camera.name = json.stringOr("name", source.name);
  if (!placeCamera(camera, world)) warnAboutDirection(context, node);
  requireNear(context, node, glm::dvec3(camera.world[3]));
  camera.perspective = json.at("type").asString() == "perspective";
  if (camera.perspective) {
    const JsonCursor lens = json.at("perspective");
    camera.yFov = lens.at("yfov").asNumber();
    camera.aspect = lens.numberOr("aspectRatio", 0.0);
    camera.zNear = lens.at("znear").asNumber();
    camera.zFar = lens.numberOr("zfar", 0.0);
  } else {
    const JsonCursor lens = json.at("orthographic");
    camera.xMag = std::abs(lens.at("xmag").asNumber());
    camera.yMag = std::abs(lens.at("ymag").asNumber());
    camera.zNear = lens.at("znear").asNumber();
    camera.zFar = lens.at("zfar").asNumber();
  }
  return camera;
}

}  // namespace prelight
