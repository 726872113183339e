#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "cast/light_groups.h"
#include "gpu/tracer.h"
#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "relight/object_shadow.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// An object as a vector occluder (Sherif 2013, chapter 7): for each of some view directions, a ball that
/// hides as much as the object, centred on its visible part. The balls are computed once by rays and move and
/// turn with the object.
class ObjectOccluder {
 public:
  /// `whole` is the scene with the object.
  ObjectOccluder(const CompiledScene& scene, const VertexRange& range, const Tracer& whole);

  /// Updates the object's position.
  void follow(const CompiledScene& scene);

  /// Returns the ball that represents the object for a point of the scene.
  ObjectBall seenFrom(const glm::dvec3& point) const;

 private:
  VertexRange range_;
  std::vector<glm::vec3> rest_;    ///< [vertex], position when the balls were computed
  ObjectBall around_;              ///< the object's ball at that position
  std::vector<ObjectBall> balls_;  ///< [texel of a cube map of directions]
  RigidMotion motion_;
};

/// Sampled places of lamps for each group of lights.
struct LampPlaces {
  struct Place {
    glm::dvec3 at{0.0};  ///< scene coordinates; for distant light the unit direction towards it
    bool isFar = false;
    double weight = 0.0;  ///< the weights of a group sum to 1
  };
  std::vector<std::vector<Place>> ofGroup;
};

LampPlaces placesOf(const CompiledScene& scene, const GroupedLights& lights);

/// Returns the share of light from a lamp's place that reaches a point past a ball. The shadow has a soft
/// edge, because the ball only resembles the object.
double lampPast(const ObjectBall& ball, const glm::dvec3& point, const LampPlaces::Place& lamp);

/// Returns the light that objects hide from the vertices of a baked scene. One ray per vertex and object,
/// through the scene without objects, finds whether the object is visible and what it hides.
ObjectShadow shadowByOccluders(const CompiledScene& scene, const VertexRange& baked,
                               std::span<const ObjectOccluder> objects, Tracer& walls, int order);

/// Returns direct light of lamps with shadows of objects, given that of VertexLights without them.
std::vector<float> lampsPastOccluders(const CompiledScene& scene, const VertexRange& baked,
                                      std::span<const ObjectOccluder> objects, const LampPlaces& lamps,
                                      std::span<const float> unhidden);

}  // namespace prelight
