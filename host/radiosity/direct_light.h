#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/incident_values.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/picture.h"
#include "prelight/progress.h"
#include "radiosity/elements.h"
#include "shared/radiosity_types.h"

namespace prelight {

/// The lights of a radiosity solution.
struct RadiosityLights {
  std::vector<Light> punctual;       ///< world space
  const Environment* sky = nullptr;  ///< nullptr: none
  double skyRotation = 0.0;          ///< radians, counter-clockwise seen from above
  bool emitters = true;              ///< whether the scene's emissive triangles are included
};

/// Direct irradiance at a point, W/m2; w is unused.
struct PointIrradiance {
  glm::vec4 far;       ///< due to punctual lights and the sky
  glm::vec4 emitters;  ///< due to emissive triangles
};

/// Computes direct light at points of elements by shadow rays: one to every punctual light, and some to
/// emissive triangles and to the sky. Up to 32 emissive triangles are integrated analytically (Lambert 1760),
/// and the rays only give the share that arrives.
class DirectLight {
 public:
  static constexpr std::size_t mostIntegratedEmitters = 32;

  /// All arguments must outlive the object. `pointsPerElement` is how many of an element's points are used,
  /// from the first on.
  DirectLight(const CompiledScene& scene, const ElementPoints& points, Tracer& tracer,
              std::uint32_t pointsPerElement);

  /// Computes light at receivers only: estimate() must not be called.
  DirectLight(const CompiledScene& scene, Tracer& tracer);

  void setLights(const RadiosityLights& lights);

  /// Returns the light at points of elements, [element of the list][point]. Throws Interrupted.
  std::vector<PointIrradiance> estimate(const std::vector<std::uint32_t>& elements, Progress& progress);

  /// Returns the light at any receivers, whose firstSample is the index of a point in a sequence.
  std::vector<PointIrradiance> at(std::span<const device::Receiver> receivers);

  /// Returns the light of punctual lights and the sky with directions: irradiance, W/m2, and incident
  /// radiance in SH of an order, [receiver][channel][value] (basis/incident_values.h).
  std::vector<float> incidentAt(std::span<const device::Receiver> receivers, int order = leastIncidentOrder);

  /// Returns whether there are too many emissive triangles to integrate, so that nearby ones are sampled by
  /// few rays.
  bool manyEmitters() const;

  std::uint32_t pointsPerElement() const { return pointsPerElement_; }
  std::uint64_t rays() const { return rays_; }  ///< number of rays so far

 private:
  std::uint32_t raysOfPoint() const { return counts_.punctual + counts_.emitterSamples + counts_.skySamples; }
  void prepareIncident(int order);
  void aimBlock(std::span<const device::Receiver> receivers);
  void estimateBlock(std::span<const device::Receiver> receivers, PointIrradiance* values);

  const CompiledScene& scene_;
  const ElementPoints* points_ = nullptr;
  Tracer& tracer_;
  DeviceContext& device_;
  std::uint32_t pointsPerElement_;
  device::DirectRays counts_{};  ///< the number of points is that of the current block
  std::size_t emitters_ = 0;
  std::uint64_t rays_ = 0;
  std::uint32_t blockPoints_ = 0;
  DeviceScene lit_;  ///< the surface with the lights, and with shading data if there are emitters
  Buffer<device::Receiver> receivers_;
  Buffer<device::Ray> rayBuffer_;
  Buffer<device::Hit> hits_;
  Buffer<float> values_;
  Buffer<PointIrradiance> irradiance_;
  int incidentOrder_ = 0;  ///< order of sumIncident_; 0: not built
  Buffer<float> incident_;

  using Receivers = Buffer<device::Receiver>;
  using Rays = Buffer<device::Ray>;
  using Hits = Buffer<device::Hit>;
  Kernel<device::DirectRays, Receivers, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::ShadingLine>, Buffer<device::LightLine>, Rays, Buffer<float>>
      aim_;
  Kernel<device::DirectRays, Buffer<device::SceneLayout>, Buffer<device::SurfaceLine>,
         Buffer<device::ShadingLine>, Buffer<device::LightLine>, Receivers, Hits, Buffer<float>,
         Buffer<PointIrradiance>>
      sum_;
  Kernel<device::DirectRays, Receivers, Rays, Hits, Buffer<float>, Buffer<float>> sumIncident_;
};

}  // namespace prelight
