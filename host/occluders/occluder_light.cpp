#include "occluders/occluder_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/occluder_places.h"

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

/// A record's vectors by what they are; only those that are stored may be looked at.
struct Record {
  const glm::vec4* position;
  const glm::vec4* occlusion;
  const glm::vec4* normal;
  const glm::vec4* color;
};

/// The records of a vertex.
class Row {
 public:
  Row(const OccluderTransfer& transfer, std::uint32_t vertex)
      : transfer_(transfer),
        first_(transfer.offsets[vertex]),
        end_(transfer.offsets[vertex + 1]),
        position_(placeOf(transfer, OccluderVector::Position)),
        occlusion_(placeOf(transfer, OccluderVector::Occlusion)),
        normal_(placeOf(transfer, OccluderVector::DiffuseNormal)),
        color_(placeOf(transfer, OccluderVector::DiffuseColor)) {}

  template <typename Visitor>
  void visit(const Visitor& visitor) const {
    for (std::size_t r = first_; r < end_; ++r) {
      const glm::vec4* vectors = transfer_.vectors.data() + r * transfer_.stored.size();
      visitor(Record{vectors + position_, vectors + occlusion_, vectors + normal_, vectors + color_});
    }
  }

 private:
  const OccluderTransfer& transfer_;
  std::size_t first_, end_;
  std::size_t position_, occlusion_, normal_, color_;
};

/// sin^(2 N F) of the angle between an occluder and the light, where that is acute, else 1.
double thesisVisibility(const Record& record, const glm::dvec3& toLight, double shadowStrength) {
  const double length = glm::length(glm::dvec3(*record.occlusion));
  if (!(length > 0.0)) return 1.0;
  const double cosine = std::clamp(glm::dot(glm::dvec3(*record.occlusion), toLight) / length, 0.0, 1.0);
  return std::pow(1.0 - cosine * cosine, shadowStrength * double(record.occlusion->w));
}

/// Unit vector of a sum of weighted ones, and its mean resultant length in [0,1]: 1 where all are alike.
std::pair<glm::dvec3, double> meanOf(const glm::vec4& sum) {
  const double length = glm::length(glm::dvec3(sum));
  if (!(length > 0.0) || !(sum.w > 0.0f)) return {glm::dvec3(0.0), 0.0};
  return {glm::dvec3(sum) / length, std::min(1.0, length / double(sum.w))};
}

/// 0 where the light lies in front of an occluder, 1 where it lies behind it: of its plane where it is flat,
/// of its distance where it is not.
double behind(const Record& record, const OccluderReceiver& receiver, const glm::dvec3& flatNormal,
              double flatness, const IncidentLight& light) {
  if (!std::isfinite(light.distance)) return 1.0;
  const double distance = std::max(double(record.position->w), 1e-9);
  const glm::dvec3 path = glm::dvec3(*record.position) - receiver.position;
  const double byPlane =
      (glm::dot(flatNormal, path) - glm::dot(flatNormal, light.toLight) * light.distance) / distance;
  const double byDistance = light.distance / distance - 1.0;
  return std::clamp((flatness * byPlane + (1.0 - flatness) * byDistance) / frontDepth, 0.0, 1.0);
}

/// How much of the light an occluder hides: a blob around its mean direction, as wide as its directions
/// differ and as it is large, narrower along the way in which its normal shows it foreshortened, and lower
/// where it fills but a part of that.
double blobOf(const Record& record, const OccluderReceiver& receiver, const IncidentLight& light,
              double& gate) {
  const double formFactor = record.occlusion->w;
  const auto [direction, resultant] = meanOf(*record.occlusion);
  const auto [normal, alike] = meanOf(*record.normal);
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

double softVisibility(const Row& row, const OccluderReceiver& receiver, const IncidentLight& light) {
  double hidden = 0.0, around = 0.0, aroundBehind = 0.0;
  row.visit([&](const Record& record) {
    const double formFactor = record.occlusion->w;
    if (!(formFactor > 0.0)) return;
    double gate = 1.0;
    const double blob = blobOf(record, receiver, light, gate);
    hidden += gate * blob;
    around += formFactor;
    aroundBehind += gate * formFactor;
  });
  const double closed = std::pow(std::min(around, 1.0), 6.0);
  hidden += enclosure * closed * aroundBehind;
  const double x = std::clamp((hidden - shadowBegins) / (shadowIsWhole - shadowBegins), 0.0, 1.0);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

double visibilityThrough(const Row& row, const OccluderReceiver& receiver, const IncidentLight& light,
                         const OccluderShading& shading) {
  if (shading.formula == OccluderFormula::Soft) return softVisibility(row, receiver, light);
  double visibility = 1.0;
  row.visit([&](const Record& record) {
    visibility *= thesisVisibility(record, light.toLight, shading.shadowStrength);
  });
  return visibility;
}

/// Light that an occluder's visible part reflects diffusely to the vertex; form factor and AO are in the
/// normal.
glm::dvec3 bleedingOf(const Record& record, const LightAt& light) {
  const IncidentLight incident = light(glm::dvec3(*record.position));
  const double cosine = glm::dot(glm::dvec3(*record.normal), incident.toLight);
  return std::max(cosine, 0.0) / std::numbers::pi * glm::dvec3(*record.color) * incident.irradiance;
}

}  // namespace

double visibilityOf(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                    const IncidentLight& light, const OccluderShading& shading) {
  return visibilityThrough(Row(transfer, receiver.vertex), receiver, light, shading);
}

glm::dvec3 lightThroughOccluders(const OccluderTransfer& transfer, const OccluderReceiver& receiver,
                                 std::span<const LightAt> lights, const OccluderShading& shading) {
  const Row row(transfer, receiver.vertex);
  glm::dvec3 sum(0.0);
  for (const LightAt& light : lights) {
    const IncidentLight incident = light(receiver.position);
    const double cosine = glm::dot(receiver.normal, incident.toLight);
    if (cosine > 0.0)
      sum += cosine * visibilityThrough(row, receiver, incident, shading) / std::numbers::pi *
             incident.irradiance;
    row.visit([&](const Record& record) { sum += shading.bleeding * bleedingOf(record, light); });
  }
  return sum;
}

}  // namespace prelight
