#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "radiosity/elements.h"

namespace prelight {

/// Mean radiance that each element of a triangle emits, W/(m2 sr), [piece]; none where the triangle emits
/// nothing.
std::vector<glm::vec3> emissionOfElements(const CompiledScene& scene, const RadiosityElements& elements,
                                          std::uint32_t triangle);

}  // namespace prelight
