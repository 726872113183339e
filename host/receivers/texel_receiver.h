#pragma once

#include "prelight/light_map.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// Returns the triangle whose front or back contains a texel's place.
std::uint32_t triangleOf(const CompiledScene& scene, const LightMapTexel& texel);

/// Returns a receiver at a texel's place, on the side of its face. The caller must set its sequence.
device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel);

}  // namespace prelight
