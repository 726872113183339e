#include "viewer/lights/receiver_lamps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace prelight::viewer {
namespace {

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

}  // namespace prelight::viewer
