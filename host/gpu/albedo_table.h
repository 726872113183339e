#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// What rough lobes reflect of light from one direction, as kernels/transport/albedo_table_funcs.cl looks it
/// up: [roughness] [cosine], then the means [roughness]. x, y: GGX with height-correlated Smith masking at
/// the first bounce, of the constant part and of the rise of Schlick's reflectance. z: sheen of colour 1
/// (Estevez and Kulla 2017), 0 unless it is asked for.
std::vector<glm::vec4> makeAlbedoTable(bool sheen = false);

/// What decides how much solid glass reflects.
struct GlassSurface {
  double ior = 1.5;  ///< 0: infinite
  glm::dvec3 f0{0.04};
  double f90 = 1.0;        ///< KHR_materials_specular's strength
  double filmShare = 0.0;  ///< of the surface, under a thin film
  double filmOutside = 1.0, filmIor = 1.3, filmThickness = 0.0;

  bool operator==(const GlassSurface&) const = default;
};

/// One of the index of refraction alone.
GlassSurface glassOfIor(double ior);

/// What solid rough glass scatters of light from one direction at the first bounce, of the channel of which
/// it reflects most: [roughness][cosine] of PRELIGHT_GLASS_ROUGHNESSES and PRELIGHT_GLASS_COSINES: x from
/// outside, y from inside (Walter et al. 2007).
std::vector<glm::vec4> makeGlassTable(const GlassSurface& surface);

}  // namespace prelight
