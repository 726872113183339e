#include "scene/animated_properties.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/magnitudes.h"

namespace prelight {

namespace {

constexpr float most = static_cast<float>(largestInput);
constexpr float halfPi = 1.57079632679f;

/// A property's numbers and their permitted range.
struct Place {
  std::span<float> numbers = {};
  double* real = nullptr;  ///< replaces `numbers` for cameras
  float least = 0.0f;
  float greatest = 1.0f;
};

Place vectorPlace(glm::vec3& vector, float greatest) { return {{&vector.x, 3}, nullptr, 0.0f, greatest}; }

Place placeIn(Material& m, AnimatedProperty property) {
  const auto number = [](float& value, float least, float greatest) {
    return Place{{&value, 1}, nullptr, least, greatest};
  };
  switch (property) {
    case AnimatedProperty::BaseColor:
      return {{&m.baseColor.x, 4}};
    case AnimatedProperty::Metallic:
      return number(m.metallic, 0.0f, 1.0f);
    case AnimatedProperty::Roughness:
      return number(m.roughness, 0.0f, 1.0f);
    case AnimatedProperty::Emission:
      return vectorPlace(m.emission, most);
    case AnimatedProperty::AlphaCutoff:
      return number(m.alphaCutoff, 0.0f, most);
    case AnimatedProperty::NormalScale:
      return number(m.normalScale, -most, most);
    case AnimatedProperty::Transmission:
      return number(m.transmission, 0.0f, 1.0f);
    case AnimatedProperty::Thickness:
      return number(m.thickness, 0.0f, most);
    case AnimatedProperty::AttenuationColor:
      return vectorPlace(m.attenuationColor, 1.0f);
    case AnimatedProperty::AttenuationDistance:
      return number(m.attenuationDistance, std::numeric_limits<float>::min(),
                    std::numeric_limits<float>::infinity());
    case AnimatedProperty::Ior:
      return number(m.ior, 0.0f, most);
    case AnimatedProperty::Specular:
      return number(m.specular, 0.0f, 1.0f);
    case AnimatedProperty::SpecularColor:
      return vectorPlace(m.specularColor, most);
    case AnimatedProperty::DiffuseTransmission:
      return number(m.diffuseTransmission, 0.0f, 1.0f);
    case AnimatedProperty::DiffuseTransmissionColor:
      return vectorPlace(m.diffuseTransmissionColor, 1.0f);
    case AnimatedProperty::Clearcoat:
      return number(m.clearcoat.factor, 0.0f, 1.0f);
    case AnimatedProperty::ClearcoatRoughness:
      return number(m.clearcoat.roughness, 0.0f, 1.0f);
    case AnimatedProperty::SheenColor:
      return vectorPlace(m.sheen.color, 1.0f);
    case AnimatedProperty::SheenRoughness:
      return number(m.sheen.roughness, 0.0f, 1.0f);
    default:
      return {};
  }
}

Place placeIn(Light& light, AnimatedProperty property) {
  switch (property) {
    case AnimatedProperty::LightIntensity:
      return vectorPlace(light.intensity, most);
    case AnimatedProperty::LightRange:
      return {{&light.range, 1}, nullptr, 0.0f, most};
    case AnimatedProperty::InnerConeAngle:
      return {{&light.innerConeAngle, 1}, nullptr, 0.0f, halfPi};
    case AnimatedProperty::OuterConeAngle:
      return {{&light.outerConeAngle, 1}, nullptr, 0.0f, halfPi};
    default:
      return {};
  }
}

Place placeIn(Camera& camera, AnimatedProperty property) {
  constexpr float tiny = 1e-6f, widest = 3.14159f;
  switch (property) {
    case AnimatedProperty::YFov:
      return {{}, &camera.yFov, tiny, widest};
    case AnimatedProperty::XMag:
      return {{}, &camera.xMag, tiny, most};
    case AnimatedProperty::YMag:
      return {{}, &camera.yMag, tiny, most};
    default:
      return {};
  }
}

bool isOfLight(AnimatedProperty property) {
  return property >= AnimatedProperty::LightIntensity && property <= AnimatedProperty::OuterConeAngle;
}

Place placeIn(Scene& scene, AnimatedProperty property, std::size_t object) {
  if (property < AnimatedProperty::LightIntensity) return placeIn(scene.materials[object], property);
  if (isOfLight(property)) return placeIn(scene.lights[object], property);
  return placeIn(scene.cameras[object], property);
}

}  // namespace

int numbersOf(AnimatedProperty property) {
  Material material;
  Light light;
  if (property >= AnimatedProperty::YFov) return 1;
  const Place place = isOfLight(property) ? placeIn(light, property) : placeIn(material, property);
  return static_cast<int>(place.numbers.size());
}

glm::vec4 propertyOf(Scene& scene, AnimatedProperty property, std::size_t object) {
  const Place place = placeIn(scene, property, object);
  glm::vec4 value(0.0f);
  if (place.real != nullptr) value.x = static_cast<float>(*place.real);
  for (std::size_t i = 0; i < place.numbers.size(); ++i) value[static_cast<int>(i)] = place.numbers[i];
  return value;
}

void setProperty(Scene& scene, AnimatedProperty property, std::size_t object, const glm::vec4& value) {
  const Place place = placeIn(scene, property, object);
  if (place.real != nullptr) *place.real = std::clamp(value.x, place.least, place.greatest);
  for (std::size_t i = 0; i < place.numbers.size(); ++i)
    place.numbers[i] = std::clamp(value[static_cast<int>(i)], place.least, place.greatest);
}

void setProperties(Scene& scene, const Animation& played, double seconds) {
  for (const Animation& animation : scene.animations)
    for (const PropertyChannel& channel : animation.properties)
      setProperty(scene, channel.property, channel.object, channel.rest);
  for (const PropertyChannel& channel : played.properties) {
    const auto at = [&](std::size_t sampler) {
      return glm::vec4(sampleAt(played.samplers[sampler], AnimatedPath::Translation, seconds));
    };
    const glm::vec4 factor =
        channel.factorSampler < 0 ? channel.factor : at(static_cast<std::size_t>(channel.factorSampler));
    setProperty(scene, channel.property, channel.object, at(channel.sampler) * factor);
    if (!isOfLight(channel.property)) continue;
    Light& light = scene.lights[channel.object];
    light.innerConeAngle = std::min(light.innerConeAngle, light.outerConeAngle);
  }
}

bool changesSurfaces(const Animation& animation) {
  return std::any_of(animation.properties.begin(), animation.properties.end(), [](const auto& channel) {
    return channel.property < AnimatedProperty::LightIntensity &&
           channel.property != AnimatedProperty::Emission;
  });
}

}  // namespace prelight
