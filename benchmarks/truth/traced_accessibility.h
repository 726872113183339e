#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight::benchmarks {

/// A camera, its picture and the rays by which accessibility is traced.
struct AccessibilityRequest {
  Camera camera;
  int width = 0, height = 0;
  double radius = 0.0;  ///< m; surfaces farther away occlude nothing
  int rays = 256;       ///< per pixel
};

/// Returns the accessibility of the surface that is visible in the middle of every pixel, [row][column]: the
/// share of cosine-distributed rays about its shading normal that hit nothing within the radius. It is
/// negative if no surface is visible. Backs of one-sided surfaces are invisible, but occlude.
std::vector<float> tracedAccessibility(const CompiledScene& scene, Tracer& tracer,
                                       const AccessibilityRequest& request);

/// Returns the radiance of the sky in a direction.
using SkyFunction = std::function<glm::vec3(const glm::dvec3&)>;

/// Returns the light of the sky at those places: irradiance over pi.
std::vector<glm::vec3> tracedSkyLight(const CompiledScene& scene, Tracer& tracer,
                                      const AccessibilityRequest& request, const SkyFunction& sky);

/// Returns the light of the sky that reaches those places after one bounce at white surfaces within the
/// radius. These surfaces are themselves occluded by what lies within the radius around them, traced by as
/// many rays each. Backs of one-sided surfaces reflect nothing.
std::vector<glm::vec3> tracedBounce(const CompiledScene& scene, Tracer& tracer,
                                    const AccessibilityRequest& request, const SkyFunction& sky,
                                    int raysOfSenders);

/// Returns the root mean square difference over all channels of pixels that show a surface.
double lightError(const std::vector<glm::vec3>& drawn, const std::vector<glm::vec3>& traced);

/// Returns the root mean square difference over pixels that show a surface.
double accessibilityError(const std::vector<float>& drawn, const std::vector<float>& traced);

/// Returns the scene with white diffuse materials, without lights and bumps. Drawn under a sky of radiance 1
/// it shows its accessibility.
Scene whitened(Scene scene);

}  // namespace prelight::benchmarks
