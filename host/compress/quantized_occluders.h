#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// Bytes of a vector in QuantizedOccluders.
std::size_t quantizedBytes(OccluderVector vector);
std::size_t quantizedBytes(const std::vector<OccluderVector>& stored);

/// The records of an OccluderTransfer in whole numbers, least byte first; `stored` as there,
/// [record][stored]:
///
///   position        distance u16, on a scale of logarithms from leastDistance to mostDistance;
///                   direction from the vertex, octahedral 8 + 8 bits; length of the way to the
///                   position over the distance u8
///   occlusion       root of the form factor u16; direction, octahedral 12 + 12 bits; root of 1 - r u8, r the
///                   length over the form factor
///   caustic, diffuseNormal, specularNormal
///                   root of their weight over the form factor u8; direction, octahedral 8 + 8 bits; length
///                   over the weight u8
///   transmissive, diffuseColor, specularColor
///                   red, green, blue u8
///
/// u8 and u16 stand for [0,1] in even steps. All that is decoded is valid: no sum is longer than its weight,
/// and none weighs more than the form factor.
struct QuantizedOccluders {
  std::vector<std::string> names;
  std::vector<OccluderVector> stored;
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> occluders;
  double leastDistance = 1.0;       ///< m, > 0
  double mostDistance = 1.0;        ///< m, >= leastDistance
  std::vector<std::uint8_t> bytes;  ///< [record][stored]
};

/// `vertices` are world space, [vertex]. The transfer must hold occlusion, and all finite.
QuantizedOccluders quantizeOccluders(const OccluderTransfer& transfer, std::span<const glm::dvec3> vertices);

/// `vertices` as above.
OccluderTransfer dequantizeOccluders(const QuantizedOccluders& quantized,
                                     std::span<const glm::dvec3> vertices);

/// One record, from its bytes to its vectors, [stored].
void dequantizeRecord(const std::vector<OccluderVector>& stored, double leastDistance, double mostDistance,
                      const glm::dvec3& vertex, const std::uint8_t* bytes, glm::vec4* vectors);

/// What quantizing costs.
struct OccluderQuantizationError {
  double formFactor = 0.0;  ///< greatest of a record
  double light = 0.0;       ///< rms of the light of 16 directions through the occluders, relative to its own
};

/// `normals`: [vertex], unit. Occluders of the two must be the same. Without positions and diffuse normals
/// the light's error is 0.
OccluderQuantizationError quantizationError(const OccluderTransfer& full, const OccluderTransfer& quantized,
                                            std::span<const glm::dvec3> vertices,
                                            std::span<const glm::vec3> normals);

}  // namespace prelight
