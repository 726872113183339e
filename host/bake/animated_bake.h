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

/// What baking an animation took.
struct AnimationReport {
  std::size_t bakes = 0;   ///< poses that were baked, keys and those tried between them
  std::size_t reused = 0;  ///< poses that were the same as one before
  std::uint64_t rays = 0;
  double error = 0.0;  ///< greatest difference between the keys where one was tried (keys by error)
  std::vector<std::string> notes;
};

/// What the state of a bake with keys depends on besides the rest of the bake.
StateKey keysKey(std::size_t animation, const KeyRequest& keys);

/// Bakes the SH transfer (request.shOrder, at least 1) of a scene at moments of one of its animations,
/// Kautz' key frames: all with the same seed, so that what does not move has the same noise in all. An
/// animation that moves no mesh has one key. `rest` is the bake of the scene as it is, `compiled` its flat
/// form: a pose that is the same is not baked again. Throws UsageError for a request without SH, else as
/// bakeScene. Poses are kept, and what is done of the one at hand.
AnimatedTransfer bakeAnimation(const Scene& scene, const CompiledScene& compiled, std::size_t animation,
                               const BakeRequest& request, const KeyRequest& keys,
                               const HarmonicTransfer& rest, const Device& device, Progress& progress,
                               AnimationReport& report);

}  // namespace prelight
