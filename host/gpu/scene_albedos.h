#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

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
