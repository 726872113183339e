#pragma once

#include <cstdint>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Bytes that the indirect light of a light map takes for a time, about: so many photons that leave the
/// lights, with the maps that are made of them, and the blocks of rays that are gathered by. Photons that
/// land are counted as in a closed scene.
std::uint64_t indirectLightBytes(const CompiledScene& scene, std::uint64_t photons);

}  // namespace prelight
