#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "benchmarks/run/measure.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// Light that arrives at a place of a surface from finitely many directions.
class IncidentLight {
 public:
  struct Sample {
    glm::dvec3 direction;  ///< unit, world space, towards where the light comes from
    glm::dvec3 power;      ///< radiance x solid angle, W/m2
  };

  IncidentLight(const glm::dmat3& frame, std::vector<Sample> samples)
      : frame_(frame), samples_(std::move(samples)) {}

  /// Columns tangent, bitangent, normal.
  const glm::dmat3& frame() const { return frame_; }

  /// W/m2 on a surface of a unit normal: the plain sum.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;

  /// As Encoding::encode() takes it.
  std::vector<float> harmonics() const;

 private:
  glm::dmat3 frame_;
  std::vector<Sample> samples_;
};

/// How light is measured.
struct IncidentRequest {
  std::size_t places = 1;     ///< places that light reaches
  int side = 32;              ///< pixels of the five pictures of a place, even
  std::uint64_t samples = 1;  ///< a pixel
  std::uint64_t seed = 0;
};

/// Light at places of the surface, chosen by area: path-traced pictures of what lies above each, and shadow
/// rays to point lights, which pictures do not show. Advances `steps` at every place.
std::vector<IncidentLight> measureIncidentLight(const BenchmarkScene& scene, const IncidentRequest& request,
                                                const Device& device, StepCounter& steps);

}  // namespace prelight::benchmarks
