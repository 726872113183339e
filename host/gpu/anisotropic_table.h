#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// What anisotropic GGX microfacets reflect of light from one direction at the first bounce, as
/// kernels/transport/anisotropic_albedo_funcs.cl looks it up, with the means over directions. It goes behind
/// makeAlbedoTable().
std::vector<glm::vec4> makeAnisotropicTable();

}  // namespace prelight
