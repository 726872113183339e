#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "occluders/occluder_light.h"
#include "prelight/transfer.h"
#include "shared/occluder_light_types.h"

namespace prelight::test {

/// Vertices and what they see, made up: every combination of vectors, records without a direction, tiny ones
/// and vertices without any.
struct MadeOccluders {
  OccluderTransfer transfer;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> gloss;  ///< reflectance, roughness; every third vertex is diffuse
};

/// `optional`: which of the four vectors that may be absent are stored.
MadeOccluders makeOccluders(std::size_t vertices, std::vector<OccluderVector> optional, std::uint32_t seed);

/// All four.
std::vector<OccluderVector> everyOptionalVector();

/// A vertex, seen from a place.
OccluderReceiver receiverOf(const MadeOccluders& made, std::size_t vertex, const glm::dvec3& eye);

/// Every parameter and effect away from its default.
OccluderShading unusualShading();

/// Lights of all kinds, the first four of four kinds, then any.
std::vector<device::OccluderLight> makeLights(std::size_t count, std::uint32_t seed);

}  // namespace prelight::test
