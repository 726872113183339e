#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"
#include "shared/ray_types.h"

namespace prelight {

/// Share of the hemisphere below which a hidden part is ignored.
constexpr double leastHidden = 1e-3;

/// Distance of the origins of rays to an object from the surface, in radii of the ball.
constexpr double rayLift = 1e-4;

/// A ball in scene coordinates.
struct ObjectBall {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// Returns a ball around vertices whose centre is that of their bounds.
ObjectBall ballAroundObject(const CompiledScene& scene, const VertexRange& range);

/// The cone around a ball, seen from a point.
struct ObjectCone {
  glm::dvec3 axis{0.0};
  double cosine = -1.0;  ///< cosine of its half angle; -1: all directions, as the point lies within the ball

  double solidAngle() const;
};

ObjectCone coneTowards(const ObjectBall& ball, const glm::dvec3& from);

/// Returns a uniformly distributed direction within the cone for `point` in [0,1)^2.
glm::dvec3 directionInCone(const ObjectCone& cone, const glm::dvec2& point);

/// Returns rays towards a ball that are spread evenly over its cone; `seed` scrambles them.
std::vector<device::Ray> raysAtBall(const ObjectBall& ball, const glm::dvec3& from, std::uint32_t count,
                                    std::uint32_t seed);

glm::dvec3 wayOf(const device::Ray& ray);

std::vector<std::uint32_t> trianglesOf(const VertexRange& range);

/// Returns an unlimited ray, whose hit distances are in lengths of `way`.
device::Ray rayAlong(const glm::dvec3& from, const glm::dvec3& way);

/// Light that objects hide from and send to the vertices of a scene, [vertex].
struct ObjectShadow {
  std::vector<float> hidden;    ///< share of the cosine-weighted hemisphere covered by objects
  std::vector<float> sky;       ///< [vertex][i], SH transfer of the covered part in front of the sky
  std::vector<float> surfaces;  ///< share of the hemisphere covered in front of surfaces
  /// [vertex][channel 3][i], SH transfer of light sent by objects; empty: nothing.
  std::vector<float> sent = {};
};

/// Casts rays from the vertices of a baked scene towards the balls around objects.
class ObjectShadowCaster {
 public:
  /// `walls` is the baked scene, and `whole` includes the objects. Both must outlive the object. `order` is
  /// the number of bands of hidden sky light.
  ObjectShadowCaster(Tracer& whole, Tracer& walls, int order) : whole_(whole), walls_(walls), order_(order) {}

  /// Returns the shadow on the vertices of `baked`, whose triangles are the scene's first; objects are later
  /// ranges.
  ObjectShadow cast(const CompiledScene& scene, const VertexRange& baked,
                    std::span<const VertexRange> objects);

 private:
  /// Rays from a vertex to an object.
  struct Aim {
    std::uint32_t vertex = 0;
    double weight = 0.0;  ///< weight of each ray, without its cosine
  };

  void castAims(const CompiledScene& scene, std::span<const Aim> aims, const std::vector<device::Ray>& rays,
                std::uint32_t bakedTriangles, ObjectShadow& shadow);

  Tracer& whole_;
  Tracer& walls_;
  int order_;
};

/// Returns the share of the light from surfaces to an object's vertices that remains in spite of the object's
/// own shadow on these surfaces, [vertex]. Visible surfaces are assumed to be lit uniformly from all sides,
/// and the object to be a ball that hides as much on average over all directions. `walls` is the scene
/// without objects.
std::vector<double> shareBesideOwnShadow(const CompiledScene& scene, const VertexRange& object,
                                         Tracer& walls);

}  // namespace prelight
