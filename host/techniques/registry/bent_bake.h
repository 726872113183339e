#pragma once

#include <optional>

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// The parts of a bake of one pose that hold, approximately, for poses that bend the scene's surface: SH
/// transfer and near lamps.
class BentBake {
 public:
  /// `bake` and `compiled` must be of one pose. They are not referred to later.
  BentBake(const Bake& bake, const CompiledScene& compiled);

  /// Returns whether a bake has parts that can be bent.
  static bool servesFor(const Bake& bake) { return bake.sh || bake.compressedSh; }

  /// Returns the parts for the pose of `posed`. Where the surface has not moved they are the bake's own.
  Bake at(const CompiledScene& posed) const;

 private:
  CompiledScene pose_;  ///< positions, normals and triangles only
  std::optional<HarmonicTransfer> sh_;
  std::optional<NearLampTransfer> nearLamps_;
};

/// Tells what a picture of a bent surface shows and lacks.
constexpr const char* bentBakeNote =
    "skins and morphs bend: their transfer follows from the pose that was baked, and shadows that have moved "
    "are "
    "missing (prelight bake --animation bakes keys)";

}  // namespace prelight
