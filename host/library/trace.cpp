#include "prelight/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gpu/tracer.h"
#include "library/library_call.h"
#include "prelight/error.h"

namespace prelight {

namespace {

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

device::Ray deviceRay(const Ray& ray, std::size_t index, const glm::dvec3& origin) {
  const double length = glm::length(ray.direction);
  if (!isFinite(ray.origin) || !isFinite(ray.direction) || !(length > 0.0) || !(ray.farthest >= 0.0))
    throw UsageError(fmt::format("Ray {}", index),
                     "expected a finite origin, a direction that is not 0, and farthest >= 0");
  const glm::vec3 from(ray.origin - origin), to(ray.direction / length);
  return {{from.x, from.y, from.z},
          PRELIGHT_NO_TRIANGLE,
          {to.x, to.y, to.z},
          static_cast<float>(std::min<double>(ray.farthest, std::numeric_limits<float>::max()))};
}

std::size_t primitiveOf(const CompiledScene& scene, std::uint32_t triangle) {
  const auto next =
      std::upper_bound(scene.primitives.begin(), scene.primitives.end(), triangle,
                       [](std::uint32_t t, const PrimitiveRange& range) { return t < range.firstTriangle; });
  return static_cast<std::size_t>(next - scene.primitives.begin()) - 1;
}

RayHit hitOf(const Ray& ray, const device::Hit& hit, const CompiledScene& scene) {
  return {.distance = hit.t,
          .triangle = hit.triangle,
          .primitive = primitiveOf(scene, hit.triangle),
          .weights = {hit.u, hit.v},
          .position = ray.origin + double(hit.t) * glm::normalize(ray.direction),
          .normal = glm::normalize(geometricNormal(scene, hit.triangle))};
}

}  // namespace

std::vector<std::optional<RayHit>> trace(const LoadedScene& scene, std::span<const Ray> rays,
                                         const TraceOptions& options) {
  std::vector<std::optional<RayHit>> found(rays.size());
  std::vector<device::Ray> deviceRays;
  deviceRays.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
    deviceRays.push_back(deviceRay(rays[i], i, scene.compiled.origin));
  if (rays.empty() || scene.compiled.triangleCount() == 0) return found;
  LibraryCall call(options.device);
  Tracer tracer(scene.compiled, call.device());
  const std::vector<device::Hit> hits = tracer.traceClosest(deviceRays);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].triangle != PRELIGHT_NO_TRIANGLE) found[i] = hitOf(rays[i], hits[i], scene.compiled);
  return found;
}

}  // namespace prelight
