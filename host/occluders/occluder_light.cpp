#include "occluders/occluder_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace prelight {

namespace {

std::size_t placeOf(const OccluderTransfer& transfer, OccluderVector vector) {
  const auto found = std::find(transfer.stored.begin(), transfer.stored.end(), vector);
  assert(found != transfer.stored.end());
  return static_cast<std::size_t>(found - transfer.stored.begin());
}

/// Where a record's vectors lie.
struct Places {
  explicit Places(const OccluderTransfer& transfer)
      : position(placeOf(transfer, OccluderVector::Position)),
        occlusion(placeOf(transfer, OccluderVector::Occlusion)),
        normal(placeOf(transfer, OccluderVector::DiffuseNormal)),
        color(placeOf(transfer, OccluderVector::DiffuseColor)) {}

  std::size_t position, occlusion, normal, color;
};

/// Light that an occluder's visible part reflects diffusely to the vertex; its form factor and AO are in the
/// normal.
glm::dvec3 bleeding(const glm::vec4* record, const Places& places, const LightAt& light) {
  const IncidentLight incident = light(glm::dvec3(record[places.position]));
  const double cosine = glm::dot(glm::dvec3(record[places.normal]), incident.toLight);
  return std::max(cosine, 0.0) / std::numbers::pi * glm::dvec3(record[places.color]) * incident.irradiance;
}

}  // namespace

double occluderVisibility(const glm::vec4& occlusion, const glm::dvec3& toLight, double shadowStrength) {
  const double length = glm::length(glm::dvec3(occlusion));
  if (!(length > 0.0)) return 1.0;
  const double cosine = std::clamp(glm::dot(glm::dvec3(occlusion), toLight) / length, 0.0, 1.0);
  return std::pow(1.0 - cosine * cosine, shadowStrength * double(occlusion.w));
}

glm::dvec3 lightThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                                 std::span<const LightAt> lights, const OccluderShading& shading) {
  const Places places(transfer);
  const std::size_t first = transfer.offsets[receiver.vertex], end = transfer.offsets[receiver.vertex + 1];
  glm::dvec3 sum(0.0);
  for (const LightAt& light : lights) {
    const IncidentLight incident = light(receiver.position);
    double visibility = std::max(glm::dot(receiver.normal, incident.toLight), 0.0);
    for (std::size_t r = first; r < end; ++r) {
      const glm::vec4* record = &transfer.vectors[r * transfer.stored.size()];
      visibility *= occluderVisibility(record[places.occlusion], incident.toLight, shading.shadowStrength);
      sum += shading.bleeding * bleeding(record, places, light);
    }
    sum += visibility / std::numbers::pi * incident.irradiance;
  }
  return sum;
}

}  // namespace prelight
