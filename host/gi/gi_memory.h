#pragma once

#include <cstdint>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns the approximate bytes that the indirect light of a light map takes temporarily, for `photons` that
/// leave lights: the photon maps and the blocks of rays for gathering. The number of photons that land is
/// that of a closed scene.
std::uint64_t indirectLightBytes(const CompiledScene& scene, std::uint64_t photons);

}  // namespace prelight
