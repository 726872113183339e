#include "scene/animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/magnitudes.h"
#include "prelight/scene.h"

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

namespace {

glm::dvec4 unitOrNone(const glm::dvec4& rotation) {
  const double length = glm::length(rotation);
  return length > 0.0 ? rotation / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

/// Interpolates two rotations spherically along the shorter arc (glTF 2.0 appendix C.4). Nearly equal
/// rotations have no angle to divide by; linear interpolation is as good then.
glm::dvec4 slerp(const glm::dvec4& from, glm::dvec4 to, double t) {
  double cosine = glm::dot(from, to);
  if (cosine < 0.0) {
    to = -to;
    cosine = -cosine;
  }
  constexpr double nearlyEqual = 1.0 - 1e-12;
  if (cosine > nearlyEqual) return unitOrNone(glm::mix(from, to, t));
  const double angle = std::acos(cosine);
  return (std::sin((1.0 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle);
}

/// Evaluates the Hermite spline of glTF 2.0 appendix C.5; `interval` seconds scale the tangents. at(key,
/// part) returns a number or a vector: part 0 the in-tangent, part 1 the value, part 2 the out-tangent.
template <class At>
auto hermite(At at, std::size_t key, double t, double interval) {
  const double t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * at(key, 1) + interval * (t3 - 2.0 * t2 + t) * at(key, 2) +
         (-2.0 * t3 + 3.0 * t2) * at(key + 1, 1) + interval * (t3 - t2) * at(key + 1, 0);
}

glm::dvec4 valueOfKey(const AnimationSampler& sampler, std::size_t key) {
  return {sampler.values[sampler.interpolation == Interpolation::CubicSpline ? 3 * key + 1 : key]};
}

glm::dvec4 between(const AnimationSampler& sampler, AnimatedPath path, std::size_t key, double seconds) {
  const double start = sampler.times[key], interval = sampler.times[key + 1] - start;
  const double t = (seconds - start) / interval;
  switch (sampler.interpolation) {
    case Interpolation::Step:
      return valueOfKey(sampler, key);
    case Interpolation::CubicSpline:
      return hermite(
          [&](std::size_t k, std::size_t part) { return glm::dvec4(sampler.values[3 * k + part]); }, key, t,
          interval);
    case Interpolation::Linear:
      break;
  }
  const glm::dvec4 from = valueOfKey(sampler, key), to = valueOfKey(sampler, key + 1);
  return path == AnimatedPath::Rotation ? slerp(unitOrNone(from), unitOrNone(to), t) : glm::mix(from, to, t);
}

std::vector<float>::const_iterator firstKeyAfter(const AnimationSampler& sampler, double seconds) {
  return std::upper_bound(sampler.times.begin(), sampler.times.end(), seconds,
                          [](double s, float time) { return s < double(time); });
}

/// Calls visit for the samplers of all channels. A sampler may be visited more than once.
template <class Visit>
void forEachSampler(const Animation& animation, Visit visit) {
  for (const AnimationChannel& channel : animation.channels) visit(animation.samplers[channel.sampler]);
  for (const PropertyChannel& channel : animation.properties) {
    visit(animation.samplers[channel.sampler]);
    if (channel.factorSampler >= 0)
      visit(animation.samplers[static_cast<std::size_t>(channel.factorSampler)]);
  }
}

}  // namespace

double Animation::startTime() const {
  std::optional<double> start;
  forEachSampler(*this, [&](const AnimationSampler& sampler) {
    start = std::min(start.value_or(sampler.times.front()), double(sampler.times.front()));
  });
  return std::max(start.value_or(0.0), 0.0);  // times before 0 cannot be requested
}

double Animation::endTime() const {
  double end = 0.0;
  forEachSampler(*this,
                 [&](const AnimationSampler& sampler) { end = std::max(end, double(sampler.times.back())); });
  return end;
}

glm::dvec4 sampleAt(const AnimationSampler& sampler, AnimatedPath path, double seconds) {
  const auto next = firstKeyAfter(sampler, seconds);
  glm::dvec4 value;
  if (next == sampler.times.begin()) {
    value = valueOfKey(sampler, 0);
  } else if (next == sampler.times.end()) {
    value = valueOfKey(sampler, sampler.times.size() - 1);
  } else {
    value = between(sampler, path, static_cast<std::size_t>(next - sampler.times.begin()) - 1, seconds);
  }
  return path == AnimatedPath::Rotation ? unitOrNone(value) : value;
}

std::vector<float> weightsAt(const AnimationSampler& sampler, double seconds) {
  const bool cubic = sampler.interpolation == Interpolation::CubicSpline;
  const auto at = [&](std::size_t key, std::size_t part, std::size_t target) {
    return double(sampler.weights[(cubic ? 3 * key + part : key) * sampler.targets + target]);
  };
  const auto next = firstKeyAfter(sampler, seconds);
  const std::size_t key =
      next == sampler.times.begin() ? 0 : static_cast<std::size_t>(next - sampler.times.begin()) - 1;
  const bool between = next != sampler.times.begin() && next != sampler.times.end() &&
                       sampler.interpolation != Interpolation::Step;
  const double interval = between ? double(sampler.times[key + 1]) - double(sampler.times[key]) : 1.0;
  const double t = (seconds - sampler.times[key]) / interval;
  std::vector<float> weights(sampler.targets);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto of = [&](std::size_t k, std::size_t part) { return at(k, part, i); };
    const double value = !between ? of(key, 1)
                         : cubic  ? hermite(of, key, t, interval)
                                  : (1.0 - t) * of(key, 1) + t * of(key + 1, 1);
    weights[i] = static_cast<float>(value);
  }
  return weights;
}

}  // namespace prelight
