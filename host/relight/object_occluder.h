#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "cast/light_groups.h"
#include "gpu/tracer.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "relight/object_ball.h"
#include "relight/object_shadow.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// An object as a vector occluder (Sherif 2013, chapter 7): for each of some directions that it is seen from
/// the ball that hides as much as it does, about the middle of what is seen. Found by rays once; it turns and
/// moves with the object.
class ObjectOccluder {
 public:
  /// `whole` is the scene with the object.
  ObjectOccluder(const CompiledScene& scene, const VertexRange& range, const Tracer& whole);

  /// The object is at another place.
  void follow(const CompiledScene& scene);

  /// As a point of the scene sees it.
  ObjectBall seenFrom(const glm::dvec3& point) const;

 private:
  VertexRange range_;
  std::vector<glm::vec3> rest_;    ///< [vertex], where it was found
  ObjectBall around_;              ///< the object there
  std::vector<ObjectBall> balls_;  ///< [texel of a cube map of directions]
  RigidMotion motion_;
};

/// Places of lamps that stand for a group of lights.
struct LampPlaces {
  struct Place {
    glm::dvec3 at{0.0};  ///< scene coordinates; of a direction: unit, towards the light
    bool isFar = false;
    double weight = 0.0;  ///< those of a group add up to 1
  };
  std::vector<std::vector<Place>> ofGroup;
};

LampPlaces placesOf(const CompiledScene& scene, const GroupedLights& lights);

/// Share of the light of a lamp's place that reaches a point past a ball: a shadow whose edge is as soft as
/// the ball's likeness to the object lets it be.
double lampPast(const ObjectBall& ball, const glm::dvec3& point, const LampPlaces::Place& lamp);

/// What objects take from the vertices of a baked scene, by a ray through the scene alone for each vertex and
/// object: whether that is seen, and what would be seen behind it.
ObjectShadow shadowByOccluders(const CompiledScene& scene, const VertexRange& baked,
                               std::span<const ObjectOccluder> objects, Tracer& walls, int order);

/// Direct light of lamps, as VertexLights gives it without objects, past them.
std::vector<float> lampsPastOccluders(const CompiledScene& scene, const VertexRange& baked,
                                      std::span<const ObjectOccluder> objects, const LampPlaces& lamps,
                                      std::span<const float> unhidden);

}  // namespace prelight
