#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "export/export_request.h"
#include "prelight/bake.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Colours of a scene's vertices that hold what was baked, times those that it has.
struct BakedColors {
  std::vector<glm::vec4> colors;  ///< [vertex], 0..1, linear; empty: the form has none
  float scale = 1.0f;             ///< W/(m2 sr) that light of 1 stands for
};

/// Light is the radiance of a white diffuse surface, over a scale above which its brightest hundredth lies.
BakedColors bakedColors(const CompiledScene& scene, const Bake& bake, ExportForm form);

}  // namespace prelight
