#include "occluders/occluder_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/occluder_record.h"
#include "occluders/occluder_tree.h"
#include "scene/deform.h"

namespace prelight {

namespace {

// Bounds of the records that determine a body's size: seen from such vertices, it is approximately a ball.
constexpr double leastCosine = 0.2;
constexpr double leastDistance = 1.5;  // in units of its reach

/// Calls visit for a leaf and all occluders that contain it.
template <typename Visit>
void forEachAbove(const OccluderMembers& members, std::uint32_t leaf, const Visit& visit) {
  for (int occluder = static_cast<int>(leaf); occluder >= 0;
       occluder = members.parent[static_cast<std::size_t>(occluder)])
    visit(static_cast<std::size_t>(occluder));
}

/// Computes centre, reach, and the radius of a ball of equal surface.
void measureShape(const CompiledScene& scene, const OccluderMembers& members,
                  std::vector<OccluderBody>& bodies) {
  const std::vector<double> areas = positiveSurfaceOfVertices(scene);
  std::vector<double> total(bodies.size(), 0.0);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v) {
    forEachAbove(members, members.leafOfVertex[v], [&](std::size_t o) {
      bodies[o].centre += areas[v] * glm::dvec3(scene.positions[v]);
      total[o] += areas[v];
    });
  }
  for (std::size_t o = 0; o < bodies.size(); ++o)
    if (total[o] > 0.0) bodies[o].centre = scene.origin + bodies[o].centre / total[o];
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    forEachAbove(members, members.leafOfVertex[v], [&](std::size_t o) {
      const glm::dvec3 path = scene.origin + glm::dvec3(scene.positions[v]) - bodies[o].centre;
      bodies[o].reach = std::max(bodies[o].reach, glm::length(path));
    });
  for (std::size_t o = 0; o < bodies.size(); ++o)
    bodies[o].radius = std::min(bodies[o].reach, std::sqrt(total[o] / (4.0 * std::numbers::pi)));
}

/// Means over the records of an occluder, weighted by form factor.
struct Means {
  double weight = 0.0;
  double accessibility = 0.0;
  glm::dvec3 color{0.0};
  glm::dvec3 transmissive{0.0};
  double farWeight = 0.0;
  double squaredRadius = 0.0;  ///< F D^2 / cos, exact for a ball above the horizon
};

void addRecord(const OccluderBody& body, const glm::dvec3& receiver, const glm::dvec3& normal,
               double formFactor, Means& means) {
  const glm::dvec3 path = body.centre - receiver;
  const double distance = glm::length(path);
  const double cosine = distance > 0.0 ? glm::dot(normal, path) / distance : 0.0;
  if (cosine < leastCosine || distance < leastDistance * body.reach) return;
  means.farWeight += formFactor;
  means.squaredRadius += formFactor * formFactor * distance * distance / cosine;
}

}  // namespace

std::optional<OccluderMembers> membersOf(const CompiledScene& scene, const OccluderTransfer& transfer) {
  for (const OccluderKind kind : {OccluderKind::Node, OccluderKind::Mesh, OccluderKind::Material}) {
    const OccluderGroups groups = makeOccluderGroups(scene, kind);
    if (groups.names == transfer.names)
      return OccluderMembers{groups.groupOfVertex, std::vector<int>(groups.names.size(), -1)};
  }
  // A binary tree with r roots and n nodes has (n + r) / 2 leaves.
  const std::size_t roots = makeOccluderGroups(scene, OccluderKind::Node).names.size();
  const OccluderTree tree = makeOccluderTree(scene, (transfer.names.size() + roots) / 2);
  if (tree.names != transfer.names) return std::nullopt;
  return OccluderMembers{tree.leafOfVertex, tree.parent};
}

std::vector<OccluderBody> bodiesOf(const CompiledScene& scene, const OccluderTransfer& transfer,
                                   const OccluderMembers& members) {
  std::vector<OccluderBody> bodies(transfer.names.size());
  measureShape(scene, members, bodies);
  std::vector<Means> means(bodies.size());
  const std::size_t width = transfer.stored.size();
  const std::size_t occlusion = placeOf(transfer, OccluderVector::Occlusion);
  const std::size_t normal = placeOf(transfer, OccluderVector::DiffuseNormal);
  const std::size_t color = placeOf(transfer, OccluderVector::DiffuseColor);
  const std::size_t transmissive = placeOf(transfer, OccluderVector::Transmissive);
  for (std::uint32_t v = 0; v < scene.vertexCount(); ++v)
    for (std::size_t r = transfer.offsets[v]; r < transfer.offsets[v + 1]; ++r) {
      const glm::vec4* record = transfer.vectors.data() + r * width;
      const double formFactor = record[occlusion].w;
      Means& mean = means[transfer.occluders[r]];
      mean.weight += formFactor;
      mean.accessibility += record[normal].w;
      mean.color += formFactor * glm::dvec3(record[color]);
      if (transmissive < width) mean.transmissive += formFactor * glm::dvec3(record[transmissive]);
      addRecord(bodies[transfer.occluders[r]], scene.origin + glm::dvec3(scene.positions[v]),
                glm::dvec3(scene.normals[v]), formFactor, mean);
    }
  for (std::size_t o = 0; o < bodies.size(); ++o) {
    if (!(means[o].weight > 0.0)) continue;
    bodies[o].accessibility = means[o].accessibility / means[o].weight;
    bodies[o].color = glm::vec3(means[o].color / means[o].weight);
    bodies[o].transmissive = glm::vec3(means[o].transmissive / means[o].weight);
    if (means[o].farWeight > 0.0)
      bodies[o].radius = std::min(bodies[o].reach, std::sqrt(means[o].squaredRadius / means[o].farWeight));
  }
  return bodies;
}

}  // namespace prelight
