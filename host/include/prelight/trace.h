#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace prelight {

class Device;
struct LoadedScene;

/// A ray in world space. The device traces it in 32-bit floats relative to CompiledScene::origin.
struct Ray {
  glm::dvec3 origin{0.0};                                     ///< m
  glm::dvec3 direction{0.0, 0.0, -1.0};                       ///< of any length but 0
  double farthest = std::numeric_limits<double>::infinity();  ///< m; what is farther is not hit
};

/// Where a ray meets the surface first.
struct RayHit {
  double distance = 0.0;       ///< m, from the ray's origin
  std::uint32_t triangle = 0;  ///< into CompiledScene::triangles
  std::size_t primitive = 0;   ///< into CompiledScene::primitives
  glm::dvec2 weights{0.0};     ///< barycentric, of the triangle's vertices 1 and 2
  glm::dvec3 position{0.0};    ///< world space
  glm::dvec3 normal{0.0};      ///< unit, geometric, away from the triangle's front; not turned to the ray
};

struct TraceOptions {
  const Device* device = nullptr;  ///< nullptr: the default one, opened for the call
};

/// The closest hit of each ray, [ray]; nothing where it leaves the scene. Both sides of triangles are hit;
/// holes of alpha masks are not. Every call builds the scene's hierarchy, so rays are best given together.
/// Throws UsageError for a ray that is not finite or has no direction, Error where the device fails.
std::vector<std::optional<RayHit>> trace(const LoadedScene& scene, std::span<const Ray> rays,
                                         const TraceOptions& options = {});

}  // namespace prelight
