#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "bvh/box.h"
#include "gpu/light_tables.h"
#include "prelight/compiled_scene.h"
#include "shared/photon_path_types.h"

namespace prelight {

/// Fewer photons of lamps far from the viewer (Larsen 2004, 9.2): by the square of the distance, in octaves
/// of their number. A lamp's photons share its power, so that fewer of them carry more, and estimates by the
/// nearest photons reach farther there.
struct PhotonThinning {
  static constexpr std::uint32_t mostOctaves = 4;  ///< to a sixteenth

  double beyond = 0.0;            ///< m: lamps farther than that are thinned; 0: none
  std::optional<glm::dvec3> eye;  ///< scene coordinates; none: no lamp is thinned
};

/// Where a lamp shines from; nothing for light from afar, which is as near everywhere.
std::optional<Box> placeOfSource(const device::PhotonSource& source, const LightTables& lights,
                                 const CompiledScene& scene);

/// How often the number of a lamp's photons is halved. It stays as it is, `before`, within a quarter of an
/// octave of where that ends, so that an eye that rests there brings no change.
std::uint32_t thinningOctaves(const PhotonThinning& thinning, const std::optional<Box>& place,
                              std::uint32_t before);

/// Photons of a lamp that is not thinned, such that every octave has a whole number.
std::uint32_t thinnable(std::uint32_t photons);

}  // namespace prelight
