#pragma once

#include <optional>
#include <string>

#include "prelight/bake.h"

namespace prelight {

/// Moments of an animation at which SH transfer is baked besides.
struct AnimationKeys {
  std::string animation = {};        ///< its name or number; empty: the first
  int count = 9;                     ///< 1..mostKeys, evenly spaced from start to end; ignored with `error`
  std::optional<double> error = {};  ///< as many as keep the relative error between them below this

  static constexpr int mostKeys = 1024;
};

/// Adds moments to what bake() has made of the same scene and request, which must hold SH. Keeps no
/// checkpoint (see bakeAnimated). Throws as bake(), and UsageError for an animation that the scene lacks.
void bakeKeys(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
              BakeResult& baked, const BakeOptions& options = {});

/// bake() and bakeKeys() in one: a checkpoint keeps the bake while its keys are baked, and those. Throws as
/// both.
BakeResult bakeAnimated(const LoadedScene& scene, const BakeRequest& request, const AnimationKeys& keys,
                        const BakeOptions& options = {});

}  // namespace prelight
