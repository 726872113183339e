#pragma once

#include "bake/surface_sampler.h"
#include "lightmap/light_map_layout.h"

namespace prelight {

/// A receiver at a texel's place, on the side of its face. Its sequence is the caller's to set.
device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel);

}  // namespace prelight
