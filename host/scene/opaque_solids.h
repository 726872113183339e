#pragma once

#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// [triangle], 1 where it belongs to a solid that something else reaches into, as far as bounds tell: a
/// closed surface of one-sided faces that look outwards and let no light through. What lies inside is not
/// seen. Empty where there is none.
std::vector<std::uint8_t> trianglesOfEnteredSolids(const CompiledScene& scene);

}  // namespace prelight
