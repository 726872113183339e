#pragma once

#include "prelight/light_map.h"
#include "receivers/surface_sampler.h"

namespace prelight {

/// The triangle whose front or back a texel lies on.
std::uint32_t triangleOf(const CompiledScene& scene, const LightMapTexel& texel);

/// A receiver at a texel's place, on the side of its face. Its sequence is the caller's to set.
device::Receiver receiverAt(const CompiledScene& scene, const LightMapTexel& texel);

}  // namespace prelight
