#include "techniques/vector_occluders/occluder_transfer.h"

#include <algorithm>

namespace prelight {

namespace {

constexpr double leastMeaning = 1e-7;  // form factor below which a record is rounding

/// What a slot sees, so that its form factors add up, with the accessibility, to 1.
std::vector<OccluderSeen> normalized(std::vector<OccluderSeen> seen, double accessibility) {
  double sum = 0.0;
  for (const OccluderSeen& s : seen) sum += s.seen.formFactor;
  const auto scale = static_cast<float>(sum > 0.0 ? (1.0 - accessibility) / sum : 0.0);
  for (OccluderSeen& s : seen) {
    OccluderSeen scaled{s.group, {}, {}};
    scaled.seen.add(s.seen, scale);
    scaled.ways.add(s.ways, scale);
    s = scaled;
  }
  return seen;
}

/// A sum over parts of the rays, as a mean over them.
glm::vec4 meanColor(const glm::vec3& sum, float weight) {
  return {weight > 0.0f ? glm::clamp(sum / weight, 0.0f, 1.0f) : glm::vec3(0.0f), 0.0f};
}

/// Where it is seen, and how far away.
glm::vec4 positionOf(const CompiledScene& scene, const SeenOccluder& seen, const glm::dvec3& vertex) {
  const glm::dvec3 position = glm::dvec3(seen.position) / double(seen.formFactor);
  // The receivers around lie to one side of a vertex at a border; what their distances are more than that to
  // the mean position, the vertex' are, too.
  const double excess = seen.distance / std::max(double(glm::length(seen.offset)), 1e-9 * seen.distance);
  const double distance = seen.distance > 0.0f ? glm::length(position - vertex) * excess : 0.0;
  return glm::vec4(scene.origin + position, distance);
}

glm::vec4 packVector(OccluderVector vector, const CompiledScene& scene, const OccluderSeen& record,
                     const glm::vec3& vertex) {
  const SeenOccluder& seen = record.seen;
  const SeenWays& ways = record.ways;
  switch (vector) {
    case OccluderVector::Position:
      return positionOf(scene, seen, glm::dvec3(vertex));
    case OccluderVector::Occlusion:
      return {seen.direction, seen.formFactor};
    case OccluderVector::Caustic:
      return {ways.throughDirection, ways.throughFactor};
    case OccluderVector::Transmissive:
      return meanColor(ways.throughColor, seen.formFactor);
    case OccluderVector::DiffuseNormal:
      return {seen.normal, seen.accessibility};
    case OccluderVector::DiffuseColor:
      return meanColor(seen.color, seen.formFactor);
    case OccluderVector::SpecularNormal:
      return {ways.mirrorNormal, ways.mirrorFactor};
    case OccluderVector::SpecularColor:
      break;
  }
  return meanColor(ways.mirrorColor, ways.mirrorFactor);
}

}  // namespace

OccluderTransfer makeOccluderTransfer(const CompiledScene& scene, const FitMesh& mesh,
                                      const OccluderMeans& means, const std::vector<double>& accessibility,
                                      const OccluderGroups& groups,
                                      const std::vector<OccluderVector>& stored) {
  OccluderTransfer transfer{groups.names, stored, {0}, {}, {}};
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    const std::uint32_t slot = mesh.slotOfVertex[v];
    for (const OccluderSeen& record : normalized(means.around(slot), accessibility[slot])) {
      if (record.seen.formFactor < leastMeaning) continue;
      transfer.occluders.push_back(record.group);
      for (const OccluderVector vector : stored)
        transfer.vectors.push_back(packVector(vector, scene, record, scene.positions[v]));
    }
    transfer.offsets.push_back(static_cast<std::uint32_t>(transfer.occluders.size()));
  }
  return transfer;
}

}  // namespace prelight
