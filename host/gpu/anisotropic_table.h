#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// Returns the share of light from one direction that anisotropic GGX microfacets reflect at the first
/// bounce, with the means over directions, as kernels/transport/anisotropic_albedo_funcs.cl looks it up. It
/// is appended to makeAlbedoTable().
std::vector<glm::vec4> makeAnisotropicTable();

}  // namespace prelight
