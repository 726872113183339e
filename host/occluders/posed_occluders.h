#pragma once

#include <memory>

#include "occluders/occluder_body.h"
#include "occluders/occluder_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Vector occluders of a scene in other poses than the one that they were baked in. What is the same for all
/// poses is made once.
class PosedOccluders {
 public:
  /// `baked` and `compiled`: the scene as `rest` is of. Throws InputError when the occluders' names are not
  /// those of its parts.
  PosedOccluders(std::shared_ptr<const OccluderTransfer> rest, const Scene& baked,
                 const CompiledScene& compiled);

  /// The records once the scene is posed like `posed`, which `compiled` may be in or not. Throws InputError
  /// where something has moved otherwise than rigidly: what is bent, scaled, or an occluder whose parts go
  /// different ways.
  OccluderTransfer at(const Scene& posed, const CompiledScene& compiled) const;

 private:
  void requireRigid(const Scene& posed) const;

  std::shared_ptr<const OccluderTransfer> rest_;  ///< the mover refers to it
  std::vector<MeshNode> nodes_;
  std::vector<Skin> skins_;
  OccluderMembers members_;
  OccluderMover mover_;
};

}  // namespace prelight
