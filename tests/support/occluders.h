#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "occluders/occluder_light.h"
#include "prelight/transfer.h"
#include "shared/occluder_light_types.h"

namespace prelight::test {

/// Made-up vertices and occluder records: every combination of vectors, records without a direction, tiny
/// records, and vertices without records.
struct MadeOccluders {
  OccluderTransfer transfer;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> gloss;  ///< Reflectance and roughness; every third vertex is diffuse.
};

/// `optional` lists the stored vectors among the four that may be absent.
MadeOccluders makeOccluders(std::size_t vertices, std::vector<OccluderVector> optional, std::uint32_t seed);

/// All four optional vectors.
std::vector<OccluderVector> everyOptionalVector();

/// Receiver at a vertex, seen from `eye`.
OccluderReceiver receiverOf(const MadeOccluders& made, std::size_t vertex, const glm::dvec3& eye);

/// Settings in which every parameter and effect differs from its default.
OccluderShading unusualShading();

/// Lights of all kinds: one of each of the four kinds first, then random kinds.
std::vector<device::OccluderLight> makeLights(std::size_t count, std::uint32_t seed);

}  // namespace prelight::test
