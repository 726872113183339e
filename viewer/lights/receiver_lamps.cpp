#include "viewer/lights/receiver_lamps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace prelight::viewer {
namespace {

// As in techniques/sh/transfer.glsl.
constexpr double leastOpen = 1e-4;
constexpr double shadowSlope = 2.0;
constexpr double leastSoft = 0.014;

/// Half the angle that a light without a shape is as large as: radiusOf() of shaders/lights.glsl.
double radiusFrom(const ShadedLight& lamp, const glm::dvec3& point) {
  if (lamp.kind == LightKind::Directional) return lamp.radius;
  const double distance = std::max(glm::length(glm::dvec3(lamp.position) - point), 1e-9);
  if (lamp.kind == LightKind::Emitter) return std::atan(std::sqrt(lamp.area / std::numbers::pi) / distance);
  return std::asin(std::min(lamp.radius / distance, 1.0));
}

}  // namespace

std::vector<ShadedLight> transferredLights(const Illumination& light) {
  std::vector<ShadedLight> lights;
  std::copy_if(light.lights.begin(), light.lights.end(), std::back_inserter(lights),
               [](const ShadedLight& source) { return source.throughTransfer; });
  return lights;
}

std::vector<ShadedLight> transferredLamps(const Illumination& light) {
  std::vector<ShadedLight> lamps;
  std::copy_if(light.lights.begin(), light.lights.end(), std::back_inserter(lamps),
               [](const ShadedLight& source) {
                 return source.throughTransfer && source.kind != LightKind::Directional;
               });
  return lamps;
}

SeenLamp seenFrom(const ShadedLight& lamp, const glm::dvec3& point, const glm::dvec3& normal) {
  const IncidentLight incident = incidentFrom(lamp, point);
  return {incident.toLight, incident.irradiance, glm::dot(normal, incident.toLight),
          lamp.kind == LightKind::Area || radiusFrom(lamp, point) >= leastSoft};
}

glm::dvec3 lampThroughTransfer(const SeenLamp& lamp, const glm::dvec3& through, double open, bool sharp) {
  if (std::abs(open) < leastOpen) open = leastOpen;
  const double slope = sharp && !lamp.isSoft ? shadowSlope : 1.0;
  const glm::dvec3 share = glm::clamp(through / open, 0.0, 1.0);
  const glm::dvec3 arriving = glm::clamp(0.5 + slope * (share - 0.5), 0.0, 1.0);
  const double facing = std::max(lamp.cosine, 0.0) / std::numbers::pi;
  return glm::max(lamp.irradiance * (through - share * open + arriving * facing), 0.0);
}

}  // namespace prelight::viewer
