#include "viewer/lights/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/colour.h"
#include "basis/sh.h"
#include "scene/light_profile.h"
#include "scene/light_shape.h"
#include "scene/light_sources.h"

namespace prelight::viewer {
namespace {

constexpr float leastDistanceShare = 1e-3f;  ///< of half the diagonal of the scene's bounds
constexpr int farSamples = 64;               ///< that stand for an area light seen from one place
constexpr double smoothingPrecision = 0.02;  ///< relative precision of the smoothing's strength

/// cos(outer) is where the cone ends: clamp(cos * scale + offset, 0, 1).
double outerAngleOf(const ShadedLight& light) {
  if (!(light.coneScale > 0.0f)) return 0.0;
  return std::acos(std::clamp(-double{light.coneOffset} / double{light.coneScale}, -1.0, 1.0));
}

Light lampOf(const ShadedLight& light) {
  Light lamp;
  lamp.profile = light.profile;
  lamp.shape = light.shape;
  lamp.cookie = light.cookie;
  lamp.outerConeAngle = static_cast<float>(outerAngleOf(light));
  lamp.direction = light.aim;
  lamp.side = light.side;
  lamp.position = light.position;
  return lamp;
}

/// Irradiance of all samples of an area light together, as if they shone from one direction.
IncidentLight incidentFromArea(const ShadedLight& light, const glm::dvec3& point) {
  glm::dvec3 sum(0.0), way(0.0);
  for (const ShadedLight& sample : samplesOf(light, farSamples)) {
    const IncidentLight part = incidentFrom(sample, point);
    const double strength = part.irradiance.r + part.irradiance.g + part.irradiance.b;
    way += strength * part.toLight;
    sum += part.irradiance;
  }
  const double strength = sum.r + sum.g + sum.b, length = glm::length(way);
  IncidentLight incident;
  if (!(length > 0.0)) return incident;
  incident.toLight = way / length;
  incident.irradiance = sum * (length / strength);
  return incident;
}

/// KHR_lights_punctual, "Inner and outer cone angles".
void setCone(const Light& light, ShadedLight& result) {
  const double inner = std::cos(light.innerConeAngle);
  const double outer = std::cos(light.outerConeAngle);
  const double scale = 1.0 / std::max(1e-3, inner - outer);
  result.coneScale = static_cast<float>(scale);
  result.coneOffset = static_cast<float>(-outer * scale);
}

void setShape(const Light& light, ShadedLight& result) {
  result.shape = light.shape;
  result.aim = light.direction;
  result.side = light.side;
  result.area = static_cast<float>(shapeArea(*light.shape));
  result.twoSided = light.shape->twoSided;
}

struct SampledEmitter {
  Emitter emitter;
  double power = 0.0;  ///< area x luminance, what decides how many samples it gets
  BodySide side = BodySide::Unclear;
};

std::vector<SampledEmitter> findEmitters(const CompiledScene& scene, std::span<const BodySide> bodies) {
  std::vector<SampledEmitter> emitters;
  std::size_t primitive = 0;
  for (const Emitter& emitter : emittersOf(scene)) {
    while (primitive + 1 < bodies.size() && scene.primitives[primitive + 1].firstTriangle <= emitter.triangle)
      ++primitive;
    const double power = emitter.area * luminance(emitter.radiance);
    if (power > 0.0)
      emitters.push_back({emitter, power, bodies.empty() ? BodySide::Unclear : bodies[primitive]});
  }
  return emitters;
}

/// A point of an emitter that follows (u, v) in [0,1)^2 uniformly by area.
glm::dvec3 pointIn(const CompiledScene& scene, const Emitter& emitter, double u, double v) {
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const glm::dvec2 place = placeOn(emitter, {u, v});
  const glm::uvec3 corners = scene.triangles[emitter.triangle];
  const glm::dvec3 a(scene.positions[corners.x]);
  return a + place.x * (glm::dvec3(scene.positions[corners.y]) - a) +
         place.y * (glm::dvec3(scene.positions[corners.z]) - a);
}

double fraction(double x) { return x - std::floor(x); }

}  // namespace

ShadedLight shadedLight(const Light& light, const CompiledScene& scene) {
  ShadedLight result;
  result.intensity = light.intensity;
  result.position = light.position - scene.origin;
  result.direction = light.direction;
  result.range = std::max(light.range, 0.0f);
  result.radius = light.radius;
  const float radius = 0.5f * glm::length(scene.boundsMax - scene.boundsMin);
  result.leastDistance = std::max(leastDistanceShare * radius, 1e-6f);
  switch (light.type) {
    case LightType::Directional:
      result.kind = LightKind::Directional;
      break;
    case LightType::Point:
      result.kind = light.profile != nullptr ? LightKind::Profiled : LightKind::Point;
      break;
    case LightType::Spot:
      result.kind = light.cookie != nullptr ? LightKind::Cookie : LightKind::Spot;
      setCone(light, result);
      if (light.cookie == nullptr) break;
      result.cookie = light.cookie;
      result.aim = light.direction;
      result.side = light.side;
      break;
    case LightType::Area:
      result.kind = LightKind::Area;
      setShape(light, result);
      break;
  }
  if (light.profile != nullptr) {
    result.profile = light.profile;
    result.aim = light.direction;
    result.side = light.side;
    result.direction = profilePole(light);
    result.profileStart = profileTurn(light);
  }
  result.throughTransfer = result.kind == LightKind::Directional || !liesWithin(light, scene);
  return result;
}

ShadedLight lightOf(const SkyLamp& lamp, double angle) {
  ShadedLight light;
  light.kind = LightKind::Directional;
  light.intensity = lamp.irradiance;
  light.direction = -(skyTurn(angle) * lamp.direction);
  light.radius = static_cast<float>(lamp.radius);
  light.ofSky = light.throughTransfer = true;
  return light;
}

device::OccluderLight occluderLight(const ShadedLight& light) {
  glm::dvec3 intensity(light.intensity);
  if (light.profile != nullptr) intensity *= profilePower(*light.profile) / (4.0 * std::numbers::pi);
  if (light.cookie != nullptr) intensity *= cookieMean(*light.cookie);
  device::OccluderLight result =
      occluderPointLight(glm::dvec3(light.position), intensity, light.leastDistance);
  for (int i = 0; i < 3; ++i) result.direction[i] = light.direction[i];
  const LightKind kind = light.kind == LightKind::Profiled ? LightKind::Point
                         : light.kind == LightKind::Cookie ? LightKind::Spot
                                                           : light.kind;
  result.kind = static_cast<float>(kind);
  if (light.kind == LightKind::Emitter) result.extent = light.area;
  result.range = light.range;
  result.coneScale = light.coneScale;
  result.coneOffset = light.coneOffset;
  result.twoSided = light.twoSided ? 1.0f : 0.0f;
  return result;
}

IncidentLight incidentFrom(const ShadedLight& light, const glm::dvec3& point) {
  if (light.kind == LightKind::Area) return incidentFromArea(light, point);
  ShadedLight even = light;
  if (light.profile != nullptr) even.kind = LightKind::Point;
  even.profile = nullptr;
  even.cookie = nullptr;
  IncidentLight incident = prelight::incidentFrom(occluderLight(even), point);
  if (light.profile != nullptr) incident.irradiance *= profileTowards(lampOf(light), -incident.toLight);
  if (light.cookie != nullptr) incident.irradiance *= cookieTowards(lampOf(light), -incident.toLight);
  return incident;
}

std::vector<ShadedLight> samplesOf(const ShadedLight& area, int count) {
  std::vector<ShadedLight> samples;
  for (const LightPatch& patch : patchesOf(lampOf(area), count)) {
    ShadedLight sample;
    sample.kind = LightKind::Emitter;
    sample.intensity = area.intensity;
    sample.position = patch.position;
    sample.direction = patch.normal;
    sample.area = area.area / static_cast<float>(count);
    sample.twoSided = area.twoSided;
    sample.throughTransfer = area.throughTransfer;
    samples.push_back(sample);
  }
  return samples;
}

std::vector<ShadedLight> sampleEmitters(const CompiledScene& scene, std::span<const BodySide> bodies,
                                        int count) {
  const std::vector<SampledEmitter> emitters = findEmitters(scene, bodies);
  double total = 0.0;
  for (const SampledEmitter& emitter : emitters) total += emitter.power;
  std::vector<ShadedLight> samples;
  std::size_t current = 0;
  double passed = 0.0;  // power of the emitters before the current one
  for (int i = 0; i < count && !emitters.empty(); ++i) {
    const double target = (i + 0.5) / count * total;
    while (current + 1 < emitters.size() && passed + emitters[current].power < target) {
      passed += emitters[current++].power;
    }
    const SampledEmitter& chosen = emitters[current];
    const Emitter& emitter = chosen.emitter;
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[emitter.triangle]];
    // Roberts' R2 sequence: low-discrepancy however many samples fall on one triangle.
    const glm::dvec3 point = pointIn(scene, emitter, fraction(0.5 + 0.7548776662466927 * i),
                                     fraction(0.5 + 0.5698402909980532 * i));
    ShadedLight sample;
    sample.kind = LightKind::Emitter;
    sample.intensity = emitter.radiance;
    sample.position = point;
    sample.direction = glm::normalize(geometricNormal(scene, emitter.triangle));
    if (chosen.side == BodySide::Inside) sample.direction = -sample.direction;
    sample.area = static_cast<float>(total / count * emitter.area / chosen.power);
    sample.twoSided = material.doubleSided && chosen.side == BodySide::Unclear;
    sample.isSample = true;
    samples.push_back(sample);
  }
  return samples;
}

SkyCoefficients::SkyCoefficients(const Environment& sky, int order)
    : order_(order), coefficients_(sh::projectEnvironment(sky, order)) {}

std::vector<glm::dvec3> SkyCoefficients::turned(double angle, int order) const {
  std::vector<glm::dvec3> result(sh::coefficientCount(order), glm::dvec3(0.0));
  if (order_ == 0) return result;
  const auto stored = static_cast<std::ptrdiff_t>(sh::coefficientCount(order_));
  const int bands = std::min(order, order_);
  const auto used = static_cast<std::size_t>(sh::coefficientCount(bands));
  std::vector<double> kept;  // rotations leave every band to itself
  for (std::ptrdiff_t c = 0; c < 3; ++c)
    kept.insert(kept.end(), coefficients_.begin() + c * stored,
                coefficients_.begin() + c * stored + static_cast<std::ptrdiff_t>(used));
  std::vector<double> rotated = kept;
  if (angle != 0.0) sh::ShRotation(bands, skyTurn(angle)).apply(kept, rotated);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < used; ++i) result[i][static_cast<glm::length_t>(c)] = rotated[c * used + i];
  return result;
}

const sh::MinimalWindow& SkyCoefficients::smoothing(int order) const {
  const auto found = smoothing_.find(order);
  if (found != smoothing_.end()) return found->second;
  std::vector<double> channels;
  const std::vector<glm::dvec3> bands = turned(0.0, order);
  for (int c = 0; c < 3; ++c)
    for (const glm::dvec3& band : bands) channels.push_back(band[c]);
  return smoothing_.emplace(order, sh::minimalWindow(channels, order, smoothingPrecision)).first->second;
}

glm::dmat3 skyTurn(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

}  // namespace prelight::viewer
