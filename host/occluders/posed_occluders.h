#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "occluders/occluder_body.h"
#include "occluders/occluder_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Greatest deviation, per entry, of a rigid motion's rotation from orthonormality.
constexpr double rigidTolerance = 1e-5;

/// Returns the motion from one transform to another, or nothing if it is not rigid within rigidTolerance.
/// Equal transforms give exactly the identity.
std::optional<RigidMotion> motionBetween(const glm::dmat4& before, const glm::dmat4& after);

/// Returns the motions of a scene's vertices and occluders between two poses of its mesh nodes, given as
/// transforms [meshNode][instance]. `compiled` is the scene in either pose. Throws InputError when a node
/// with triangles is scaled or sheared and when parts of one occluder move differently.
OccluderMotions motionsBetween(const Scene& scene, const CompiledScene& compiled,
                               const OccluderMembers& members,
                               const std::vector<std::vector<glm::dmat4>>& before,
                               const std::vector<std::vector<glm::dmat4>>& after,
                               const std::vector<std::string>& occluderNames);

/// Vector occluders of a scene in other poses than that of their bake. Data common to all poses is made once.
class PosedOccluders {
 public:
  /// `baked` and `compiled` are the scene in the pose of `rest`. Throws InputError when the occluders' names
  /// do not match the scene's parts.
  PosedOccluders(std::shared_ptr<const OccluderTransfer> rest, const Scene& baked,
                 const CompiledScene& compiled);

  /// Returns the records for the pose of `posed`; `compiled` may be in any pose. Throws InputError for parts
  /// that do not move rigidly: bent or scaled ones, and occluders whose parts move differently.
  OccluderTransfer at(const Scene& posed, const CompiledScene& compiled) const;

 private:
  void requireRigid(const Scene& posed) const;

  std::shared_ptr<const OccluderTransfer> rest_;  ///< keeps the transfer alive for the mover
  std::vector<MeshNode> nodes_;
  std::vector<Skin> skins_;
  OccluderMembers members_;
  OccluderMover mover_;
};

}  // namespace prelight
