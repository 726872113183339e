#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::benchmarks {

/// A picture of which the accessibility is traced.
struct AccessibilityRequest {
  Camera camera;
  int width = 0, height = 0;
  double radius = 0.0;  ///< m; what is farther occludes nothing
  int rays = 256;       ///< a pixel
};

/// Accessibility of the surface seen in the middle of every pixel, [row][column]: the share of rays, as dense
/// about its shading normal as the cosine, that meet nothing within the radius. Negative where nothing is
/// seen. Backs of one-sided surfaces are not seen, but occlude.
std::vector<float> tracedAccessibility(const CompiledScene& scene, Tracer& tracer,
                                       const AccessibilityRequest& request);

/// Radiance of a direction.
using SkyFunction = std::function<glm::vec3(const glm::dvec3&)>;

/// Light of the sky at those places, irradiance over pi.
std::vector<glm::vec3> tracedSkyLight(const CompiledScene& scene, Tracer& tracer,
                                      const AccessibilityRequest& request, const SkyFunction& sky);

/// Light at those places that white surfaces within the radius send on of the sky's, which they receive past
/// what lies within the radius of them, by so many rays each. Backs of one-sided surfaces send nothing.
std::vector<glm::vec3> tracedBounce(const CompiledScene& scene, Tracer& tracer,
                                    const AccessibilityRequest& request, const SkyFunction& sky,
                                    int raysOfSenders);

/// Root mean square over all channels of the difference where a surface is seen.
double lightError(const std::vector<glm::vec3>& drawn, const std::vector<glm::vec3>& traced);

/// Root mean square of the difference where a surface is seen.
double accessibilityError(const std::vector<float>& drawn, const std::vector<float>& traced);

/// The scene in white, diffuse, without light and bumps: under a sky of radiance 1, what is drawn of it is
/// its accessibility.
Scene whitened(Scene scene);

}  // namespace prelight::benchmarks
