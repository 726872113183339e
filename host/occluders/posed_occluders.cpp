#include "occluders/posed_occluders.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "occluders/scene_motion.h"
#include "prelight/error.h"

namespace prelight {

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
