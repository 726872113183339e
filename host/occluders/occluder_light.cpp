#include "occluders/occluder_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/occluder_record.h"
#include "occluders/occluder_terms.h"

namespace prelight {

namespace {

// Of the soft formula. Least squares over shapes, swing, Duck and bumps with other lights than those that it
// is judged by; two fits on disjoint scenes came out alike (docs/occluders.md).
constexpr double widthOfSpread = 0.77;  // of a blob, for directions that differ
constexpr double widthOfSize = 0.17;    // and for the solid angle over pi
constexpr double leastWidth = 1e-4;
constexpr double cosineSlack = 0.1;  // between form factor and solid angle at the horizon
constexpr double amplitude = 0.55;   // of a blob, by its solid angle over its width
constexpr double mostAmplitude = 2.0;
constexpr double flatShare = 0.95;  // of the foreshortening of something flat
constexpr double facingGain = 3.0;  // cosine at which normals that are alike make a plane: 1 / 3
constexpr double frontDepth =
    0.2;  // of the mean distance, over which a light comes to lie behind an occluder
constexpr double enclosure = 0.55;      // closes what is left between blobs that surround a vertex
constexpr double shadowBegins = 0.075;  // sum of blobs
constexpr double shadowIsWhole = 0.65;
constexpr double opaque = 0.99999;
constexpr double mostMagnification = 32.0;  // of light by the thesis' caustics

/// 0 where the light lies in front of an occluder, 1 where it lies behind it: of its plane where it is flat,
/// of its distance where it is not.
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

/// How much of the light an occluder hides: a blob around its mean direction, as wide as its directions
/// differ and as it is large, narrower along the way in which its normal shows it foreshortened, and lower
/// where it fills but a part of that.
double blobOf(const OccluderRecord& record, const OccluderReceiver& receiver, const IncidentLight& light,
              double& gate) {
  const double formFactor = record.occlusion.w;
  const auto [direction, resultant] = meanOf(record.occlusion);
  const auto [normal, alike] = meanOf(record.normal);
  const double facing = glm::dot(normal, direction);
  // AO takes what touches the receiver out of the normals. The few that are left of a cone that stands on the
  // receiver's floor are alike, but its base is no plane of theirs: a plane that is seen faces who sees it.
  const double flatness = alike * std::clamp(-facingGain * facing, 0.0, 1.0);
  gate = behind(record, receiver, normal, flatness, light);
  const double size = formFactor / (std::max(glm::dot(receiver.normal, direction), 0.0) + cosineSlack);
  const double width = widthOfSpread * (1.0 - resultant) + widthOfSize * size + leastWidth;
  // AO damps the normals of just those parts that lie close: how alike they are says little of how flat it
  // is.
  const double s = alike > 0.0 ? flatShare : 0.0;
  const double foreshortening = 1.001 - s * (1.0 - facing * facing);
  const double along = glm::dot(direction, light.toLight);
  const double across = glm::dot(normal, light.toLight) - facing * along;
  const double reach =
      (1.0 - along + 0.5 * s / foreshortening * across * across) * std::sqrt(foreshortening) / width;
  return std::min(mostAmplitude, amplitude * size / width) * std::exp(-std::min(reach, 60.0));
}

/// Sum of blobs that is as dark as an opacity: the inverse of the smoothstep below. What is opaque has none.
glm::dvec3 levelOf(const glm::dvec3& opacity) {
  glm::dvec3 level(mostAmplitude);
  for (int c = 0; c < 3; ++c)
    if (opacity[c] < opaque)
      level[c] =
          shadowBegins + (shadowIsWhole - shadowBegins) *
                             (0.5 - std::sin(std::asin(std::clamp(1.0 - 2.0 * opacity[c], -1.0, 1.0)) / 3.0));
  return level;
}

/// Visibility a channel. A clear occluder alone is never darker than it is opaque.
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

/// Light that an occluder's visible part reflects diffusely to the vertex; form factor and AO are in the
/// normal.
glm::dvec3 bleedingOf(const OccluderRecord& record, const IncidentLight& there) {
  const double cosine = glm::dot(glm::dvec3(record.normal), there.toLight);
  return std::max(cosine, 0.0) / std::numbers::pi * glm::dvec3(record.color) * there.irradiance;
}

/// Sums over lights that are not yet what is shown.
struct Sums {
  OccludedLight light;
  double highlights = 0.0;      ///< reflection of all lights
  double openHighlights = 0.0;  ///< the same without shadows
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
