#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/light_map.h"
#include "prelight/progress.h"
#include "receivers/fit_mesh.h"

namespace prelight {

/// Returns the irradiance of the fronts at every vertex, W/m2, such that its interpolation comes closest to
/// the light map (least squares over the surface); 0 where no face around a vertex has a chart. Throws
/// Interrupted; the sums so far are kept.
std::vector<glm::vec3> irradianceOfVertices(const CompiledScene& scene, const FitMesh& mesh,
                                            const LightMap& map, const Progress& progress = Progress());

/// As irradianceOfVertices, for incident radiance that the map holds in SH of order n: [vertex][channel 3][n
/// n].
std::vector<float> incidentOfVertices(const CompiledScene& scene, const FitMesh& mesh, const LightMap& map,
                                      const Progress& progress = Progress());

}  // namespace prelight
