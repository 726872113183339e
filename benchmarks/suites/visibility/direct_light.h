#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"

namespace prelight::benchmarks {

/// Error of shadows that are computed at vertices and interpolated, against shadows traced at random points
/// of the surface: of the direct light (cosine x visibility, of unit intensity whatever the distance) of
/// point lights. Every surface is opaque.
class DirectLight {
 public:
  /// Visibility in [0,1] of a light at a vertex; called from several threads.
  using Visibility = std::function<double(std::size_t light, std::uint32_t vertex)>;

  /// Traces the truth at `points` points, chosen by area and `seed`. Lights are in scene coordinates; the
  /// tracer is of the scene, which outlives this.
  DirectLight(const CompiledScene& scene, Tracer& tracer, std::vector<glm::dvec3> lights, std::size_t points,
              std::uint64_t seed);

  /// Root of the mean square, over points and lights, of the difference to the truth.
  double error(const Visibility& visibility) const;

  /// Visibility traced at the vertices: what interpolation allows.
  double tracedAtVertex(std::size_t light, std::uint32_t vertex) const {
    return vertexVisible_[light][vertex];
  }

  const std::vector<glm::dvec3>& lights() const { return lights_; }

 private:
  struct Sample {
    glm::uvec3 corners;
    glm::dvec3 weights;  ///< barycentric
    glm::dvec3 position;
    glm::dvec3 normal;  ///< interpolated, unit
  };

  void chooseSamples(std::size_t points, std::uint64_t seed);

  const CompiledScene& scene_;
  std::vector<glm::dvec3> lights_;
  std::vector<Sample> samples_;
  std::vector<std::vector<double>> truth_;                ///< [light][sample], cosine x visibility
  std::vector<std::vector<std::uint8_t>> vertexVisible_;  ///< [light][vertex], 0 or 1
};

}  // namespace prelight::benchmarks
