#pragma once

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

}  // namespace prelight
