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

/// Many rays in world space, in arrays of 32-bit floats.
struct RayArrays {
  std::span<const glm::vec3> origins;     ///< [ray], m
  std::span<const glm::vec3> directions;  ///< [ray], of any length but 0
  std::span<const float> farthest = {};   ///< [ray], m, >= 0; empty: no limit
};

/// What a ray of many meets, as small as the device has it.
struct ArrayHit {
  static constexpr std::int32_t none = -1;

  float distance = std::numeric_limits<float>::infinity();  ///< m; infinite where nothing is hit
  std::int32_t triangle = none;                             ///< into CompiledScene::triangles
  glm::vec2 weights{0.0f};                                  ///< barycentric, of its vertices 1 and 2
};

/// A scene that rays are traced in again and again: its hierarchy is built once.
class RayTracer {
 public:
  /// The scene is not kept. Throws Error where the device fails.
  explicit RayTracer(const LoadedScene& scene, const TraceOptions& options = {});
  RayTracer(RayTracer&&) noexcept;
  RayTracer& operator=(RayTracer&&) noexcept;
  ~RayTracer();

  /// The closest hit of each ray, as trace() finds it; `hits` are as many as rays. Throws UsageError for
  /// arrays that are not of one length and for a ray that is not finite or has no direction, Error where the
  /// device fails.
  void closest(const RayArrays& rays, std::span<ArrayHit> hits);

  /// Whether something lies on each ray, 1 or 0; cheaper than the closest.
  void blocked(const RayArrays& rays, std::span<std::uint8_t> blocked);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace prelight
