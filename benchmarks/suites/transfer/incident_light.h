#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "benchmarks/run/measure.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// Light that arrives at a point of a surface from finitely many directions.
class IncidentLight {
 public:
  struct Sample {
    glm::dvec3 direction;  ///< unit vector towards the origin of the light, world space
    glm::dvec3 power;      ///< radiance x solid angle, W/m2
  };

  IncidentLight(const glm::dmat3& frame, std::vector<Sample> samples)
      : frame_(frame), samples_(std::move(samples)) {}

  /// Returns the matrix with columns tangent, bitangent and normal.
  const glm::dmat3& frame() const { return frame_; }

  /// Returns the irradiance of a surface with a unit normal, W/m2, as a plain sum.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;

  /// Returns the light as Encoding::encode() takes it.
  std::vector<float> harmonics() const;

 private:
  glm::dmat3 frame_;
  std::vector<Sample> samples_;
};

/// Places, pictures and samples of measured light.
struct IncidentRequest {
  std::size_t places = 1;     ///< number of points that light reaches
  int side = 32;              ///< pixels per side of the five pictures of a point, even
  std::uint64_t samples = 1;  ///< per pixel
  std::uint64_t seed = 0;
};

/// Returns the light at points of the surface, chosen by area, from path-traced pictures of the hemisphere
/// above each, and shadow rays to point lights, which pictures do not show. Advances `steps` per point.
std::vector<IncidentLight> measureIncidentLight(const BenchmarkScene& scene, const IncidentRequest& request,
                                                const Device& device, StepCounter& steps);

}  // namespace prelight::benchmarks
