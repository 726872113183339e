#include "occluders/posed_occluders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plan/shadow_sets.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();

/// Returns the index of a motion, which is added if it is new.
std::uint32_t indexOf(const RigidMotion& motion, std::vector<RigidMotion>& motions) {
  const auto found = std::find(motions.begin(), motions.end(), motion);
  const auto index = static_cast<std::uint32_t>(found - motions.begin());
  if (found == motions.end()) motions.push_back(motion);
  return index;
}

const glm::dmat4& transformOf(const Scene& scene, const PrimitiveRange& range,
                              const std::vector<std::vector<glm::dmat4>>& transforms) {
  const auto node = std::find_if(scene.meshNodes.begin(), scene.meshNodes.end(),
                                 [&](const MeshNode& mesh) { return mesh.node == range.node; });
  return transforms[static_cast<std::size_t>(node - scene.meshNodes.begin())]
                   [static_cast<std::size_t>(range.instance)];
}

/// Gives every occluder the motion of its members, who must share one.
void setOccluderMotions(const OccluderMembers& members, const std::vector<std::string>& names,
                        OccluderMotions& motions) {
  motions.ofOccluder.assign(names.size(), unknown);
  for (std::size_t v = 0; v < motions.ofVertex.size(); ++v)
    for (int o = static_cast<int>(members.leafOfVertex[v]); o >= 0;
         o = members.parent[static_cast<std::size_t>(o)]) {
      std::uint32_t& motion = motions.ofOccluder[static_cast<std::size_t>(o)];
      if (motion == unknown) motion = motions.ofVertex[v];
      if (motion != motions.ofVertex[v])
        throw InputError("vector occluders",
                         fmt::format("parts of occluder \"{}\" move in different ways",
                                     names[static_cast<std::size_t>(o)]),
                         "bake with OccluderKind::Node or OccluderKind::Auto");
    }
  std::replace(motions.ofOccluder.begin(), motions.ofOccluder.end(), unknown, 0u);
}

}  // namespace

std::optional<RigidMotion> motionBetween(const glm::dmat4& before, const glm::dmat4& after) {
  if (before == after) return RigidMotion{};
  const glm::dmat4 map = after * glm::inverse(before);
  RigidMotion motion{glm::dmat3(map), glm::dvec3(map[3])};
  const glm::dmat3 product = glm::transpose(motion.rotation) * motion.rotation;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(product[column][row] - (row == column ? 1.0 : 0.0)) <= rigidTolerance))
        return std::nullopt;
  if (!(glm::determinant(motion.rotation) > 0.0)) return std::nullopt;
  return motion;
}

OccluderMotions motionsBetween(const Scene& scene, const CompiledScene& compiled,
                               const OccluderMembers& members,
                               const std::vector<std::vector<glm::dmat4>>& before,
                               const std::vector<std::vector<glm::dmat4>>& after,
                               const std::vector<std::string>& occluderNames) {
  OccluderMotions motions;
  motions.motions.push_back({});
  motions.ofVertex.assign(compiled.vertexCount(), 0);
  for (const PrimitiveRange& range : compiled.primitives) {
    if (range.triangleCount == 0) continue;
    const auto motion = motionBetween(transformOf(scene, range, before), transformOf(scene, range, after));
    if (!motion)
      throw InputError(
          "vector occluders",
          fmt::format("node \"{}\" is scaled or sheared, and they only move rigidly", nodeNameOf(range)),
          "bake the scene in that pose");
    std::fill_n(motions.ofVertex.begin() + range.firstVertex, range.vertexCount,
                indexOf(*motion, motions.motions));
  }
  setOccluderMotions(members, occluderNames, motions);
  return motions;
}

namespace {

OccluderMembers requiredMembers(const CompiledScene& compiled, const OccluderTransfer& rest) {
  auto members = membersOf(compiled, rest);
  if (!members)
    throw InputError("vector occluders", "their names are not those of the scene's parts", "bake it anew");
  return std::move(*members);
}

std::vector<std::vector<glm::dmat4>> placesOf(const std::vector<MeshNode>& nodes) {
  std::vector<std::vector<glm::dmat4>> transforms;
  for (const MeshNode& node : nodes) transforms.push_back(node.transforms);
  return transforms;
}

}  // namespace

PosedOccluders::PosedOccluders(std::shared_ptr<const OccluderTransfer> rest, const Scene& baked,
                               const CompiledScene& compiled)
    : rest_(std::move(rest)),
      nodes_(baked.meshNodes),
      skins_(baked.skins),
      members_(requiredMembers(compiled, *rest_)),
      mover_(*rest_, compiled, members_) {}

void PosedOccluders::requireRigid(const Scene& posed) const {
  for (std::size_t n = 0; n < posed.meshNodes.size(); ++n) {
    const MeshNode& node = posed.meshNodes[n];
    const auto skin = static_cast<std::size_t>(std::max(node.skin, 0));
    const bool bent = node.skin >= 0 && skins_[skin].toWorld != posed.skins[skin].toWorld;
    if (bent || nodes_[n].weights != node.weights)
      throw InputError("vector occluders",
                       fmt::format("node \"{}\" is bent, and they only move rigidly", node.name),
                       "bake the scene in that pose");
  }
}

OccluderTransfer PosedOccluders::at(const Scene& posed, const CompiledScene& compiled) const {
  requireRigid(posed);
  return mover_.moved(
      motionsBetween(posed, compiled, members_, placesOf(nodes_), placesOf(posed.meshNodes), rest_->names));
}

}  // namespace prelight
