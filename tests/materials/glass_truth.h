#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "materials/grid_scene.h"

namespace prelight::test {

/// Mean radiance of a picture of a cell of smooth glass, followed in double precision through a sphere or a
/// card as KHR_materials_transmission and KHR_materials_volume define them. Empty for other cells.
std::optional<glm::dvec3> glassTruth(const GridCell& cell, int pixels);

}  // namespace prelight::test
