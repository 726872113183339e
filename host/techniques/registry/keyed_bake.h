#pragma once

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns what the keys of an animation hold for one of its moments, interpolated. `scene` and `compiled`
/// may be in any pose.
Bake bakeAt(const AnimatedTransfer& keys, const Scene& scene, const CompiledScene& compiled, double seconds);

/// Returns the bytes of a key of an animation with transfer as a bake has it, or, if it has none, as a
/// request asks for it.
std::size_t bytesOfKey(const Bake& bake, const BakeRequest& request, std::size_t vertices);

/// The parts of a bake of one pose that hold, approximately, for poses that bend the scene's surface by skins
/// or morph targets.
class BentBake {
 public:
  /// `bake` and `compiled` must be of one pose. They are not referred to later.
  BentBake(const Bake& bake, const CompiledScene& compiled);

  /// Returns whether a bake has parts that can be bent.
  static bool servesFor(const Bake& bake);

  /// Returns the parts for the pose of `posed`. Where the surface has not moved they are the bake's own.
  Bake at(const CompiledScene& posed) const;

 private:
  CompiledScene pose_;  ///< positions, normals and triangles only
  Bake parts_;          ///< only those that are bent
};

/// Tells what a picture of a bent surface shows and lacks.
constexpr const char* bentBakeNote =
    "skins and morphs bend: their transfer follows from the pose that was baked, and shadows that have moved "
    "are missing (a bake of the moment, or keys of the animation, would have them)";

}  // namespace prelight
