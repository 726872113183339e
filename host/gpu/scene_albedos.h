#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// What is looked up of lobes, and where the tables of materials begin in it.
struct SceneAlbedos {
  /// makeAlbedoTable(), then makeAnisotropicTable() where something is anisotropic, then a table for each
  /// index of refraction of solid rough glass and for each film.
  std::vector<glm::vec4> texels;
  std::vector<std::uint32_t> glassTables;  ///< [material]
  std::vector<std::uint32_t> filmTables;   ///< [material]
};

/// Of the materials that are used, [material].
SceneAlbedos makeSceneAlbedos(const CompiledScene& scene, const std::vector<bool>& used);

}  // namespace prelight
