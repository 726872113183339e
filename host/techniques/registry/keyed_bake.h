#pragma once

#include "prelight/bake.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Returns what the keys of an animation hold for one of its moments, interpolated. `scene` and `compiled`
/// may be in any pose.
Bake bakeAt(const AnimatedTransfer& keys, const Scene& scene, const CompiledScene& compiled, double seconds);

}  // namespace prelight
