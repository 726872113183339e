#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns the share of light from one direction that rough lobes reflect, as
/// kernels/transport/albedo_table_funcs.cl looks it up: [roughness][cosine], then the means over directions
/// [roughness], then mean directions of lobes (lobeLean()) [roughness][cosine]. x, y: GGX with
/// height-correlated Smith masking at the first bounce, for the constant part and for the rise of Schlick's
/// reflectance. z: sheen of colour 1 (Estevez and Kulla 2017), or 0 unless `sheen` is set.
std::vector<glm::vec4> makeAlbedoTable(bool sheen = false);

/// Properties that decide how much solid glass reflects.
struct GlassSurface {
  double ior = 1.5;  ///< 0 means infinite
  glm::dvec3 f0{0.04};
  double f90 = 1.0;        ///< strength of KHR_materials_specular
  double filmShare = 0.0;  ///< share of the surface under a thin film
  double filmOutside = 1.0, filmIor = 1.3, filmThickness = 0.0;

  bool operator==(const GlassSurface&) const = default;
};

/// Returns glass that is defined by its index of refraction alone.
GlassSurface glassOfIor(double ior);

/// Returns the share of light from one direction that solid rough glass scatters at the first bounce (Walter
/// et al. 2007), for the channel with the highest reflectance: [roughness][cosine],
/// PRELIGHT_GLASS_ROUGHNESSES by PRELIGHT_GLASS_COSINES; x is from outside, y from inside.
std::vector<glm::vec4> makeGlassTable(const GlassSurface& surface);

/// Look-up tables of lobes, and where the tables of materials begin in them.
struct SceneAlbedos {
  /// makeAlbedoTable(), then makeAnisotropicTable() if any material is anisotropic, then a table for each
  /// kind of solid rough glass and for each film.
  std::vector<glm::vec4> texels;
  std::vector<std::uint32_t> glassTables;  ///< [material]
  std::vector<std::uint32_t> filmTables;   ///< [material]
};

/// Returns the tables of the used materials, [material].
SceneAlbedos makeSceneAlbedos(const CompiledScene& scene, const std::vector<bool>& used);

}  // namespace prelight
