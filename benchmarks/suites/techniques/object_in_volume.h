#pragma once

#include "benchmarks/scenes/compared_scenes.h"

namespace prelight::benchmarks {

/// A bake of a scene without the object that was put into it, whose SH transfer goes on with that of the
/// object's vertices, which the bake's volume lights, and has its shadow. `request` asks for SH, a volume and
/// bounces; `scene.put` is there.
TimedBake bakeAround(const ComparedScene& scene, const BakeRequest& request, const Device& device,
                     const Progress& progress);

}  // namespace prelight::benchmarks
