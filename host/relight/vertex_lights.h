#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "cast/light_column.h"
#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// Consecutive vertices of a scene, and the consecutive triangles that use them.
struct VertexRange {
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
};

/// Direct light of light groups at vertices, by shadow rays to every lamp. It is exact at vertices except for
/// the noise of lamps with an extent. Receivers lie within the triangles, close to each vertex, so that none
/// sees past a wall that meets the surface there.
class VertexLights {
 public:
  /// The arguments must outlive the object. `scene` is what the tracer was made of.
  VertexLights(const CompiledScene& scene, const GroupedLights& lights, Tracer& tracer);

  std::uint32_t groupCount() const { return caster_.groupCount(); }

  /// Returns exit radiance over albedo and the group's colour, [vertex of the range][channel 3][group].
  /// `scene` must have its vertices where the tracer's triangles are.
  std::vector<float> at(const CompiledScene& scene, const VertexRange& range);

 private:
  void castBlock(const std::vector<device::Receiver>& receivers, std::vector<float>& values);
  void aimRays(const std::vector<device::Receiver>& receivers, std::uint32_t pass);

  Tracer& tracer_;
  std::uint32_t blockSize_;  ///< receivers that are processed at a time
  LightCaster caster_;
  Buffer<device::CastParameters> parameters_;
  Buffer<device::Receiver> receivers_;
  Buffer<device::Ray> rays_;
  Buffer<device::Hit> hits_;
};

/// Rays from an object to the scene begin at this fraction of the way from the vertex to the object's centre,
/// so that touching surfaces do not hide everything.
constexpr float towardsMiddle = 0.02f;

struct ObjectBounds {
  glm::vec3 lower{std::numeric_limits<float>::max()};
  glm::vec3 upper{std::numeric_limits<float>::lowest()};
};

/// Returns the bounds of vertices in scene coordinates.
inline ObjectBounds boundsOf(const CompiledScene& scene, const VertexRange& range) {
  ObjectBounds bounds;
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    bounds.lower = glm::min(bounds.lower, scene.positions[v]);
    bounds.upper = glm::max(bounds.upper, scene.positions[v]);
  }
  return bounds;
}

/// Returns the centre of their bounds.
inline glm::vec3 middleOf(const CompiledScene& scene, const VertexRange& range) {
  const ObjectBounds bounds = boundsOf(scene, range);
  return 0.5f * (bounds.lower + bounds.upper);
}

}  // namespace prelight
