#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// What rough lobes reflect of light from one direction, as kernels/transport/albedo_table_funcs.cl looks it
/// up: [roughness] [cosine], then the means [roughness]. x, y: GGX with height-correlated Smith masking at
/// the first bounce, of the constant part and of the rise of Schlick's reflectance. z: sheen of colour 1
/// (Estevez and Kulla 2017), 0 unless it is asked for.
std::vector<glm::vec4> makeAlbedoTable(bool sheen = false);

}  // namespace prelight
