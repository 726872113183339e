#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bake/key_choice.h"
#include "base/state_file.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/progress.h"
#include "prelight/scene.h"

namespace prelight {

/// Statistics of baking an animation.
struct AnimationReport {
  std::size_t bakes = 0;   ///< poses that were baked, keys and those tried between them
  std::size_t reused = 0;  ///< poses equal to one baked before
  std::uint64_t rays = 0;
  /// Greatest relative difference between a tried pose and the interpolated keys (keys by error).
  double error = 0.0;
  std::vector<std::string> notes;
};

/// Key of the state of a bake with keys: what the keys depend on besides the rest of the bake.
StateKey keysKey(std::size_t animation, const KeyRequest& keys);

/// Bakes the SH transfer (ShRequest::order, at least 1), and the near lamps that `rest` has, of a scene at
/// moments of one of its animations, which are Kautz' key frames. All poses share one seed, so that surfaces
/// that do not move have the same noise in each. An animation that moves no mesh has one key. `rest` is the
/// bake of the scene at rest and `compiled` its flat form; poses equal to it are not baked again. Finished
/// poses and the pose under way are kept. Throws UsageError for a request without SH, else as bakeScene().
AnimatedTransfer bakeAnimation(const Scene& scene, const CompiledScene& compiled, std::size_t animation,
                               const BakeRequest& request, const KeyRequest& keys, const Bake& rest,
                               const Device& device, Progress& progress, AnimationReport& report);

}  // namespace prelight
