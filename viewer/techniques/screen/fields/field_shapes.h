#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "occluders/rigid_motion.h"
#include "prelight/compiled_scene.h"
#include "prelight/device.h"
#include "techniques/volume/occlusion_field.h"
#include "viewer/techniques/screen/fields/scene_objects.h"

namespace prelight::viewer {

/// Occlusion that objects share that differ by rigid motions: around an object and on itself.
struct FieldShape {
  int mesh = -1;                  ///< into Scene::meshes
  std::vector<glm::vec3> places;  ///< of the vertices of the object that it was made of, scene coordinates
  OcclusionField field;           ///< around that
  std::vector<float> own;         ///< [vertex], accessibility among nothing but the object
};

/// The objects of a scene with their fields: an object takes along what it hides of others and of itself.
class FieldShapes {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Placed {
    SceneObject object;
    std::size_t shape = none;  ///< none: nothing of it occludes
    RigidMotion motion;        ///< from the shape's place to where the object is, scene coordinates
  };

  /// Casts a field for every shape, and bakes what it hides of itself.
  FieldShapes(const CompiledScene& scene, const Device& device, const OcclusionFieldOptions& options);

  /// Vertices are where the scene has them now. What bends or is scaled takes its field along by the rigid
  /// motion that is nearest.
  void follow(const CompiledScene& scene);

  const std::vector<FieldShape>& shapes() const { return shapes_; }
  const std::vector<Placed>& objects() const { return objects_; }

  /// [vertex], accessibility among nothing but the object that it belongs to.
  std::vector<float> ownAccessibility(const CompiledScene& scene) const;

  /// [triangle], the number of its object.
  std::vector<float> ownersOf(const CompiledScene& scene) const;

 private:
  bool findShape(int mesh, Placed& placed, const std::vector<glm::vec3>& places) const;

  std::vector<FieldShape> shapes_;
  std::vector<Placed> objects_;
};

}  // namespace prelight::viewer
