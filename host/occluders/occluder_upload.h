#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "occluders/occluder_light.h"
#include "prelight/transfer.h"
#include "shared/occluder_light_types.h"

namespace prelight {

/// Where pictures are taken from.
struct OccluderEye {
  glm::dvec3 position{0.0};  ///< scene coordinates; or, where `isPoint` is false, the unit direction to it
  bool isPoint = true;

  bool operator==(const OccluderEye&) const = default;
};

/// A transfer as shaders and kernels read it, whatever it was stored with.
struct OccluderUpload {
  std::vector<glm::vec4> records;    ///< [record][stored], positions in scene coordinates
  std::vector<std::int32_t> owners;  ///< [record], vertex
  int stored = 0;                    ///< PRELIGHT_STORES_... of what shading uses
  int stride = 0;                    ///< vec4 of a prepared record
  std::size_t longestRow = 0;        ///< records of a vertex, at most

  /// `origin`: of scene coordinates, world.
  OccluderUpload(const OccluderTransfer& transfer, const glm::dvec3& origin);

  device::OccluderTerms terms(const OccluderShading& shading, const OccluderEye& eye,
                              std::size_t lightCount) const;
};

/// What a prepared record depends on, of terms: others may change without preparing anew.
bool samePreparation(const device::OccluderTerms& a, const device::OccluderTerms& b);

/// Lights as the kernels take them, scene coordinates. `leastDistance`, m, bounds the irradiance: nearer than
/// that a light is no stronger.
device::OccluderLight occluderPointLight(const glm::dvec3& position, const glm::dvec3& intensity,
                                         double leastDistance);
device::OccluderLight occluderFarLight(const glm::dvec3& toLight, const glm::dvec3& irradiance);

/// What the reference takes for such a light.
IncidentLight incidentFrom(const device::OccluderLight& light, const glm::dvec3& point);

}  // namespace prelight
