#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// Bytes that a vector takes in QuantizedOccluders.
std::size_t quantizedBytes(OccluderVector vector);
std::size_t quantizedBytes(const std::vector<OccluderVector>& stored);

/// The records of an OccluderTransfer in integers, little endian; `stored` is as in OccluderTransfer. The
/// order is [record][stored]:
///
///   position        distance u16, on a logarithmic scale from leastDistance to mostDistance;
///                   direction from the vertex, octahedral 8 + 8 bits; length of the vector to the
///                   position over the distance u8
///   occlusion       root of the form factor u16; direction, octahedral 12 + 12 bits; root of 1 - r u8, r the
///                   length over the form factor
///   caustic, diffuseNormal, specularNormal
///                   root of their weight over the form factor u8; direction, octahedral 8 + 8 bits; length
///                   over the weight u8
///   transmissive, diffuseColor, specularColor
///                   red, green, blue u8
///
/// Values u8 and u16 stand for [0,1] in even steps. All decoded records are valid: no sum is longer than its
/// weight, and no weight exceeds the form factor.
struct QuantizedOccluders {
  std::vector<std::string> names;
  std::vector<OccluderVector> stored;
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint32_t> occluders;
  double leastDistance = 1.0;       ///< m, > 0
  double mostDistance = 1.0;        ///< m, >= leastDistance
  std::vector<std::uint8_t> bytes;  ///< [record][stored]
};

/// Quantises a transfer. `vertices` are in world space, [vertex]. The transfer must hold occlusion and finite
/// values.
QuantizedOccluders quantizeOccluders(const OccluderTransfer& transfer, std::span<const glm::dvec3> vertices);

/// Decodes a transfer. `vertices` are in world space, [vertex].
OccluderTransfer dequantizeOccluders(const QuantizedOccluders& quantized,
                                     std::span<const glm::dvec3> vertices);

/// Decodes one record from its bytes to its vectors, [stored].
void dequantizeRecord(const std::vector<OccluderVector>& stored, double leastDistance, double mostDistance,
                      const glm::dvec3& vertex, const std::uint8_t* bytes, glm::vec4* vectors);

/// Error of the quantisation.
struct OccluderQuantizationError {
  double formFactor = 0.0;  ///< greatest absolute error of a record
  /// RMS error of the light of 16 directions through the occluders, relative to the RMS of that light.
  double light = 0.0;
};

/// Compares a transfer with its quantised form, which must have the same occluders. `normals` are unit
/// vectors, [vertex]. The light's error is 0 without positions and diffuse normals.
OccluderQuantizationError quantizationError(const OccluderTransfer& full, const OccluderTransfer& quantized,
                                            std::span<const glm::dvec3> vertices,
                                            std::span<const glm::vec3> normals);

}  // namespace prelight
