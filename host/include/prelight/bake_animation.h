#pragma once

#include <optional>
#include <string>

#include "prelight/bake.h"

namespace prelight {

/// Moments of an animation at which SH transfer is baked in addition to the rest pose.
struct AnimationKeys {
  std::string animation = {};  ///< name or number of the animation; empty: the first
  int count = 9;               ///< 1 to mostKeys, evenly spaced from start to end; ignored with `error`
  /// Bakes as many keys as the relative error between them needs to stay below this.
  std::optional<double> error = {};

  static constexpr int mostKeys = 1024;
};

/// Adds keys of an animation to the result of bake() for the same scene and request, which must include SH.
/// Keeps no checkpoint (see bakeAnimated). Throws as bake() does, and UsageError for an animation that the
/// scene lacks.
void bakeKeys(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
              BakeResult& baked, const BakeOptions& options = {});

/// Does bake() and bakeKeys() in one call whose checkpoint covers both. Throws as they do.
BakeResult bakeAnimated(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
                        const BakeOptions& options = {});

}  // namespace prelight
