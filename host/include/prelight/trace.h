#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace prelight {

class Device;
struct LoadedScene;

/// A ray in world space. The device traces it in 32-bit floats relative to CompiledScene::origin.
struct Ray {
  glm::dvec3 origin{0.0};                                     ///< m
  glm::dvec3 direction{0.0, 0.0, -1.0};                       ///< may have any length but 0
  double farthest = std::numeric_limits<double>::infinity();  ///< m; surfaces beyond are not hit
};

/// The first intersection of a ray with the surface.
struct RayHit {
  double distance = 0.0;       ///< m, from the ray's origin
  std::uint32_t triangle = 0;  ///< into CompiledScene::triangles
  std::size_t primitive = 0;   ///< into CompiledScene::primitives
  glm::dvec2 weights{0.0};     ///< barycentric, of the triangle's vertices 1 and 2
  glm::dvec3 position{0.0};    ///< world space
  /// Unit geometric normal on the triangle's front side, whatever the ray's direction.
  glm::dvec3 normal{0.0};
};

/// Options of trace() and RayTracer.
struct TraceOptions {
  const Device* device = nullptr;  ///< nullptr: the default device, opened for the call
};

/// Returns the closest hit of each ray, [ray], or nothing where the ray leaves the scene. Both sides of
/// triangles are hit; holes of alpha masks are not. Every call builds the hierarchy of the scene, so pass
/// many rays at once. Throws UsageError for a ray that is not finite or has no direction, and Error where the
/// device fails.
std::vector<std::optional<RayHit>> trace(const LoadedScene& scene, std::span<const Ray> rays,
                                         const TraceOptions& options = {});

/// Many rays in world space, in arrays of 32-bit floats.
struct RayArrays {
  std::span<const glm::vec3> origins;     ///< [ray], m
  std::span<const glm::vec3> directions;  ///< [ray], of any length but 0
  std::span<const float> farthest = {};   ///< [ray], m, >= 0; empty: no limit
};

/// Hit of a ray in an array, in the device's compact form.
struct ArrayHit {
  static constexpr std::int32_t none = -1;

  float distance = std::numeric_limits<float>::infinity();  ///< m; infinite where nothing is hit
  std::int32_t triangle = none;                             ///< into CompiledScene::triangles
  glm::vec2 weights{0.0f};                                  ///< barycentric, of its vertices 1 and 2
};

/// Traces rays in a scene whose hierarchy is built once.
class RayTracer {
 public:
  /// Builds the hierarchy. The scene is not kept. Throws Error where the device fails.
  explicit RayTracer(const LoadedScene& scene, const TraceOptions& options = {});
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;
  ~RayTracer();

  /// Finds the closest hit of each ray as trace() does. `hits` has one entry per ray. Throws UsageError for
  /// arrays of different lengths and for a ray that is not finite or has no direction, and Error where the
  /// device fails.
  void closest(const RayArrays& rays, std::span<ArrayHit> hits);

  /// Writes 1 for each ray that hits something, else 0. Cheaper than closest().
  void blocked(const RayArrays& rays, std::span<std::uint8_t> blocked);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace prelight
