#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "radiosity/elements.h"

namespace prelight {

/// Returns the mean radiance that each element of a triangle emits, W/(m2 sr), [piece], or nothing if the
/// triangle does not emit.
std::vector<glm::vec3> emissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                          std::uint32_t triangle);

}  // namespace prelight
