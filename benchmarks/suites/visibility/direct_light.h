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
/// of the surface. What is compared is the direct light of point lights: cosine x visibility, of unit
/// intensity at any distance. Every surface is opaque. Points inside solids do not count: nobody sees them,
/// and fits of vertices give them next to no weight.
class DirectLight {
 public:
  /// A point of the surface and its unit normal.
  struct LitPlace {
    glm::dvec3 position;
    glm::dvec3 normal;
  };

  /// Visibility in [0,1] of a light at a vertex; called from several threads.
  using Visibility = std::function<double(std::size_t light, std::uint32_t vertex)>;

  /// Traces the truth at those of `points` points, chosen by area and `seed`, that lie in no solid. Lights
  /// are in scene coordinates; the tracer holds the scene, which outlives this.
  DirectLight(const CompiledScene& scene, Tracer& tracer, std::vector<glm::dvec3> lights, std::size_t points,
              std::uint64_t seed);

  /// Returns the root mean square difference to the truth over points and lights.
  double error(const Visibility& visibility) const;

  /// Returns visibility traced at a vertex, whose error is due to interpolation alone.
  double tracedAtVertex(std::size_t light, std::uint32_t vertex) const {
    return vertexVisible_[light][vertex];
  }

  std::size_t sampleCount() const { return samples_.size(); }
  const std::vector<glm::dvec3>& lights() const { return lights_; }

 private:
  struct Sample {
    glm::uvec3 corners;
    glm::dvec3 weights;  ///< barycentric
    glm::dvec3 position;
    glm::dvec3 normal;  ///< interpolated, unit
  };

  void chooseSamples(std::size_t points, std::uint64_t seed);
  void dropHiddenSamples(Tracer& tracer, double offset);
  std::vector<LitPlace> samplePlaces() const;

  const CompiledScene& scene_;
  std::vector<glm::dvec3> lights_;
  std::vector<Sample> samples_;
  std::vector<std::vector<double>> truth_;                ///< [light][sample], cosine x visibility
  std::vector<std::vector<std::uint8_t>> vertexVisible_;  ///< [light][vertex], 0 or 1
};

}  // namespace prelight::benchmarks
