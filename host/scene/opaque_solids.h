#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns [triangle] 1 where it belongs to a solid into which other surfaces reach, judged by bounds: a
/// closed surface of opaque, one-sided faces that look outwards. Surfaces inside it are not visible. Empty
/// where there is none.
std::vector<std::uint8_t> trianglesOfEnteredSolids(const CompiledScene& scene);

}  // namespace prelight
