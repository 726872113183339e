#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bvh/binary_bvh.h"
#include "gpu/light_tables.h"
#include "prelight/compiled_scene.h"
#include "shared/photon_path_types.h"
#include "shared/ray_types.h"

namespace prelight {

/// Returns a few boxes around triangles at their present places, one for each run of consecutive triangles
/// (an object's primitive). `triangles` ascend.
std::vector<Box> boxesAround(const CompiledScene& scene, std::span<const std::uint32_t> triangles);

/// Returns whether a ray may meet a box before its end; true in case of doubt.
bool mayMeet(const device::Ray& ray, const Box& box);

/// Reduces the photons of lamps far from the viewer (Larsen 2004, 9.2) with the square of the distance, in
/// octaves of their number. The photons of a lamp share its power, so that fewer photons carry more each, and
/// estimates by the nearest photons reach farther there.
struct PhotonThinning {
  static constexpr std::uint32_t mostOctaves = 4;  ///< down to a sixteenth

  double beyond = 0.0;            ///< m; lamps farther than this are thinned; 0: none
  std::optional<glm::dvec3> eye;  ///< scene coordinates; none: no lamp is thinned
};

/// Returns the bounds of a lamp, or nothing for distant light, whose distance is the same everywhere.
std::optional<Box> placeOfSource(const device::PhotonSource& source, const LightTables& lights,
                                 const CompiledScene& scene);

/// Returns how often a lamp's number of photons is halved. The present value `before` is kept within a
/// quarter of an octave beyond its limits, so that an eye resting at a limit causes no changes.
std::uint32_t thinningOctaves(const PhotonThinning& thinning, const std::optional<Box>& place,
                              std::uint32_t before);

/// Rounds a lamp's number of photons up, so that each octave halves it exactly.
std::uint32_t thinnable(std::uint32_t photons);

}  // namespace prelight
