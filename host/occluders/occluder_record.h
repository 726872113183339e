#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/transfer.h"

namespace prelight {

/// A record's vectors in double precision. Vectors that are not stored are zero.
struct OccluderRecord {
  glm::dvec4 position{0.0};
  glm::dvec4 occlusion{0.0};
  glm::dvec4 caustic{0.0};
  glm::dvec4 transmissive{0.0};
  glm::dvec4 normal{0.0};
  glm::dvec4 color{0.0};
  glm::dvec4 mirrorNormal{0.0};
  glm::dvec4 mirrorColor{0.0};
};

/// The records of a vertex, and which optional vectors they have.
struct OccluderRow {
  std::vector<OccluderRecord> records;
  bool hasCaustic = false;
  bool hasTransmissive = false;
  bool hasSpecular = false;
};

OccluderRow occluderRow(const OccluderTransfer& transfer, std::size_t vertex);

/// Unit vector of a weighted sum of directions, and its mean resultant length in [0,1], 1 if all are equal.
struct MeanDirection {
  glm::dvec3 direction{0.0};  ///< zero if the sum is
  double resultant = 0.0;
};
MeanDirection meanOf(const glm::dvec4& sum);

/// Returns whether a vector is a sum over a share of the hemisphere, which scales and turns with it; other
/// vectors are means.
inline bool isSum(OccluderVector vector) {
  return vector == OccluderVector::Occlusion || vector == OccluderVector::Caustic ||
         vector == OccluderVector::DiffuseNormal || vector == OccluderVector::SpecularNormal;
}

/// Returns the index of a vector in a transfer's records, or stored.size() if it is not stored.
inline std::size_t placeOf(const OccluderTransfer& transfer, OccluderVector vector) {
  const auto found = std::find(transfer.stored.begin(), transfer.stored.end(), vector);
  return static_cast<std::size_t>(found - transfer.stored.begin());
}

/// Returns the share in [0,1] of a cosine-weighted hemisphere that a ball covers, where part of it may be
/// below the horizon (Howell, catalogue of configuration factors, differential element to sphere). `cosine`
/// is that between the element's normal and the direction of the centre; `sine` is radius over distance of
/// the centre, in [0,1).
double ballFormFactor(double cosine, double sine);

}  // namespace prelight
