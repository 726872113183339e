#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// What rough lobes reflect of light from one direction, as kernels/transport/albedo_table_funcs.cl looks it
/// up: [roughness] [cosine], then the means [roughness]. x, y: GGX with height-correlated Smith masking at
/// the first bounce, of the constant part and of the rise of Schlick's reflectance. z: sheen of colour 1
/// (Estevez and Kulla 2017), 0 unless it is asked for.
std::vector<glm::vec4> makeAlbedoTable(bool sheen = false);

/// What solid rough glass of this index of refraction (0: infinite) scatters of light from one direction at
/// the first bounce, [roughness][cosine] of PRELIGHT_GLASS_ROUGHNESSES and PRELIGHT_GLASS_COSINES: x from
/// outside, y from inside (Walter et al. 2007).
std::vector<glm::vec4> makeGlassTable(double ior);

}  // namespace prelight
