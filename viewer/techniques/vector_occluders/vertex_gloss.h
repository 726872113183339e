#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/core/render_inputs.h"

namespace prelight::viewer {

/// Specular reflection of every vertex, [vertex]: reflectance along the normal, roughness; textures are
/// looked up at the vertex. Unless `all`, it is scaled by how much of a surface is metal or glass, as
/// surface.frag scales highlights. A vertex of several materials has the last triangle's.
std::vector<glm::vec4> vertexGloss(const RenderInputs& inputs, bool all);

}  // namespace prelight::viewer
