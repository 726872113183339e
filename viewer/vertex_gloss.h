#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/render.h"

namespace prelight::viewer {

/// What every vertex reflects, [vertex]: reflectance along the normal, roughness; textures are looked up at
/// the vertex. Unless `all`, it is scaled by how much of a surface is metal or glass, as surface.frag scales
/// highlights. A vertex of several materials has the last triangle's.
std::vector<glm::vec4> vertexGloss(const RenderInputs& inputs, bool all);

}  // namespace prelight::viewer
