#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "occluders/occluder_light.h"
#include "prelight/transfer.h"
#include "shared/occluder_light_types.h"

namespace prelight {

/// The viewpoint of pictures.
struct OccluderEye {
  /// Scene coordinates; if `isPoint` is false, the unit direction towards the viewer.
  glm::dvec3 position{0.0};
  bool isPoint = true;

  bool operator==(const OccluderEye&) const = default;
};

/// A transfer in the layout of shaders and kernels, whichever vectors it stores.
struct OccluderUpload {
  std::vector<glm::vec4> records;    ///< [record][stored], positions in scene coordinates
  std::vector<std::int32_t> owners;  ///< [record], vertex that owns it
  int stored = 0;                    ///< PRELIGHT_STORES_... of the vectors that shading uses
  int stride = 0;                    ///< size of a prepared record in vec4
  std::size_t longestRow = 0;        ///< most records per vertex

  /// `origin` is the world-space origin of scene coordinates.
  OccluderUpload(const OccluderTransfer& transfer, const glm::dvec3& origin);

  device::OccluderTerms terms(const OccluderShading& shading, const OccluderEye& eye,
                              std::size_t lightCount) const;
};

/// Returns whether terms agree in everything that prepared records depend on, so that these remain valid.
bool samePreparation(const device::OccluderTerms& a, const device::OccluderTerms& b);

/// Return lights for the kernels, in scene coordinates. `leastDistance`, m, bounds the irradiance, which does
/// not increase further at shorter distances.
device::OccluderLight occluderPointLight(const glm::dvec3& position, const glm::dvec3& intensity,
                                         double leastDistance);
device::OccluderLight occluderFarLight(const glm::dvec3& toLight, const glm::dvec3& irradiance);

/// Returns such a light as the reference takes it.
IncidentLight incidentFrom(const device::OccluderLight& light, const glm::dvec3& point);

}  // namespace prelight
