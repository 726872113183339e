#include "occluders/occluder_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/occluder_record.h"
#include "occluders/occluder_terms.h"

namespace prelight {

namespace {

// Constants of the soft formula. They are least-squares fits over the scenes shapes, swing, Duck and bumps,
// with other lights than those used for evaluation; two fits on disjoint scenes agreed
// (docs/notes/occluders.md).
constexpr double widthOfSpread = 0.77;  // contribution of the spread of directions to the width of a blob
constexpr double widthOfSize = 0.17;    // contribution of the solid angle over pi to it
constexpr double leastBlobWidth = 1e-4;
constexpr double cosineSlack = 0.1;  // offset between form factor and solid angle at the horizon
constexpr double amplitude = 0.55;   // height of a blob, for its solid angle over its width
constexpr double mostAmplitude = 2.0;
constexpr double flatShare = 0.95;  // share of the foreshortening of flat occluders that counts
constexpr double facingGain = 3.0;  // parallel normals count as a plane from a cosine of 1 / 3 on
// Relative to the mean distance: depth over which a light passes behind an occluder.
constexpr double frontDepth = 0.2;
constexpr double enclosure = 0.55;      // closes gaps between blobs that surround a vertex
constexpr double shadowBegins = 0.075;  // sum of blobs
constexpr double shadowIsWhole = 0.65;
constexpr double opaque = 0.99999;
constexpr double mostMagnification = 32.0;  // largest factor of light in the thesis' caustics

/// Returns 0 for a light in front of an occluder and 1 for a light behind it, relative to the plane of a flat
/// occluder, else by distance.
double behind(const OccluderRecord& record, const OccluderReceiver& receiver, const glm::dvec3& flatNormal,
              double flatness, const IncidentLight& light) {
  if (!std::isfinite(light.distance)) return 1.0;
  const double distance = std::max(record.position.w, 1e-9);
  const glm::dvec3 path = glm::dvec3(record.position) - receiver.position;
  const double byPlane =
      (glm::dot(flatNormal, path) - glm::dot(flatNormal, light.toLight) * light.distance) / distance;
  const double byDistance = light.distance / distance - 1.0;
  return std::clamp((flatness * byPlane + (1.0 - flatness) * byDistance) / frontDepth, 0.0, 1.0);
}

/// Returns how much of the light an occluder hides: a blob around its mean direction, whose width grows with
/// the spread of directions and with size. It is narrower in the direction in which its normal shows
/// foreshortening, and lower where the occluder fills only a part of it.
double blobOf(const OccluderRecord& record, const OccluderReceiver& receiver, const IncidentLight& light,
              double& gate) {
  const double formFactor = record.occlusion.w;
  const auto [direction, resultant] = meanOf(record.occlusion);
  const auto [normal, alike] = meanOf(record.normal);
  const double facing = glm::dot(normal, direction);
  // AO removes parts that touch the receiver from the normals. For a cone standing on the receiver's floor,
  // the few remaining normals are parallel, but they are not those of a plane: a visible plane must face the
  // receiver.
  const double flatness = alike * std::clamp(-facingGain * facing, 0.0, 1.0);
  gate = behind(record, receiver, normal, flatness, light);
  const double size = formFactor / (std::max(glm::dot(receiver.normal, direction), 0.0) + cosineSlack);
  const double width = widthOfSpread * (1.0 - resultant) + widthOfSize * size + leastBlobWidth;
  // AO also reduces the normals of close parts, so that their resultant says little about flatness.
  const double s = alike > 0.0 ? flatShare : 0.0;
  const double foreshortening = 1.001 - s * (1.0 - facing * facing);
  const double along = glm::dot(direction, light.toLight);
  const double across = glm::dot(normal, light.toLight) - facing * along;
  const double reach =
      (1.0 - along + 0.5 * s / foreshortening * across * across) * std::sqrt(foreshortening) / width;
  return std::min(mostAmplitude, amplitude * size / width) * std::exp(-std::min(reach, 60.0));
}

/// Returns the sum of blobs that is as dark as an opacity: the inverse of the smoothstep below. Opaque
/// occluders have no limit.
glm::dvec3 levelOf(const glm::dvec3& opacity) {
  glm::dvec3 level(mostAmplitude);
  for (int c = 0; c < 3; ++c)
    if (opacity[c] < opaque)
      level[c] =
          shadowBegins + (shadowIsWhole - shadowBegins) *
                             (0.5 - std::sin(std::asin(std::clamp(1.0 - 2.0 * opacity[c], -1.0, 1.0)) / 3.0));
  return level;
}

/// Returns the visibility per channel. A single transparent occluder never makes it darker than its opacity.
glm::dvec3 softVisibility(const OccluderRow& row, const OccluderReceiver& receiver,
                          const IncidentLight& light, const OccluderShading& shading) {
  glm::dvec3 hidden(0.0), aroundBehind(0.0);
  double around = 0.0;
  for (const OccluderRecord& record : row.records) {
    const double formFactor = record.occlusion.w;
    if (!(formFactor > 0.0)) continue;
    const glm::dvec3 opacity = shadowOpacity(row, record, shading);
    double gate = 1.0;
    const double blob = blobOf(record, receiver, light, gate);
    hidden += gate * glm::min(glm::dvec3(blob), levelOf(opacity));
    around += formFactor;
    aroundBehind += gate * formFactor * opacity;
  }
  const double closed = std::pow(std::min(around, 1.0), 6.0);
  hidden += enclosure * closed * aroundBehind;
  const glm::dvec3 x = glm::clamp((hidden - shadowBegins) / (shadowIsWhole - shadowBegins), 0.0, 1.0);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

glm::dvec3 visibilityThrough(const OccluderRow& row, const OccluderReceiver& receiver,
                             const IncidentLight& light, const OccluderShading& shading) {
  if (shading.formula == OccluderFormula::Soft) return softVisibility(row, receiver, light, shading);
  glm::dvec3 factor(1.0);
  for (const OccluderRecord& record : row.records)
    if (record.occlusion.w > 0.0)
      factor = glm::min(factor * thesisFactor(row, record, light.toLight, shading), mostMagnification);
  return factor;
}

/// Returns the light that an occluder's visible part reflects diffusely to the vertex. The normal includes
/// form factor and AO.
glm::dvec3 bleedingOf(const OccluderRecord& record, const IncidentLight& there) {
  const double cosine = glm::dot(glm::dvec3(record.normal), there.toLight);
  return std::max(cosine, 0.0) / std::numbers::pi * glm::dvec3(record.color) * there.irradiance;
}

/// Sums over lights from which the final light is computed.
struct Sums {
  OccludedLight light;
  double highlights = 0.0;      ///< reflection of all lights
  double openHighlights = 0.0;  ///< unshadowed reflection of all lights
};

void addDirect(const OccluderRow& row, const OccluderReceiver& receiver, const IncidentLight& incident,
               const glm::dvec3& flicker, const OccluderShading& shading, Sums& sums) {
  const double cosine = glm::dot(receiver.normal, incident.toLight);
  if (!(cosine > 0.0)) return;
  const glm::dvec3 open = cosine * incident.irradiance;
  const glm::dvec3 reached = open * flicker * visibilityThrough(row, receiver, incident, shading);
  const double rough =
      shading.receiver == DiffuseReceiver::OrenNayar ? roughDiffuse(receiver, incident.toLight) : 1.0;
  sums.light.diffuse += rough / std::numbers::pi * reached;
  if (!incident.highlights || receiver.f0 == glm::dvec3(0.0)) return;
  sums.light.specular += glossyBrdf(receiver, incident.toLight) * reached;
  const double shine = highlightWeight(receiver, incident.toLight);
  sums.highlights += shine * (reached.x + reached.y + reached.z);
  sums.openHighlights += shine * (open.x + open.y + open.z);
}

void addIndirect(const OccluderRow& row, const OccluderReceiver& receiver, const LightAt& light,
                 const glm::dvec3& flicker, const OccluderShading& shading, OccludedLight& sum) {
  for (const OccluderRecord& record : row.records) {
    IncidentLight there = light(glm::dvec3(record.position));
    there.irradiance *= flicker;
    sum.diffuse += shading.bleeding * bleedingOf(record, there);
    sum.diffuse += causticLight(row, record, there, shading);
    if (!row.hasSpecular) continue;
    sum.diffuse += mirroredLight(receiver, record, there, shading);
    if (receiver.f0 != glm::dvec3(0.0)) sum.reflected += mirroredAgain(receiver, record, there, shading);
  }
}

}  // namespace

double visibilityOf(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                    const IncidentLight& light, const OccluderShading& shading) {
  OccluderRow row = occluderRow(transfer, receiver.vertex);
  row.hasCaustic = row.hasTransmissive = false;
  return visibilityThrough(row, receiver, light, shading).x;
}

OccludedLight litThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& asItIs,
                                  std::span<const LightAt> lights, const OccluderShading& shading) {
  const OccluderReceiver receiver = bentReceiver(asItIs, shading.effects);
  OccluderRow row = occluderRow(transfer, receiver.vertex);
  for (OccluderRecord& record : row.records) record = bentRecord(receiver, record, shading.effects);
  Sums sums;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const glm::dvec3 flicker = flickerOf(i, shading.effects);
    addDirect(row, receiver, lights[i](receiver.position), flicker, shading, sums);
    addIndirect(row, receiver, lights[i], flicker, shading, sums.light);
  }
  sums.light.diffuse = glm::max(sums.light.diffuse, glm::dvec3(0.0));
  if (sums.openHighlights > 0.0) sums.light.highlight = sums.highlights / sums.openHighlights;
  return sums.light;
}

}  // namespace prelight
