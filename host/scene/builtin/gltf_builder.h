#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "prelight/make_scene.h"
#include "prelight/scene.h"
#include "scene/builtin/mesh_shapes.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Makes a glTF document part by part. All parts are named; every node is a root of the one scene.
class GltfBuilder {
 public:
  explicit GltfBuilder(const std::string& sceneName);

  /// Untextured Lambertian surface: no metal, no specular. `albedo` is linear.
  int addDiffuse(const std::string& name, const glm::vec3& albedo);
  /// A diffuse surface with a normal map that repeats so often along each texture coordinate.
  int addBumpy(const std::string& name, const glm::vec3& albedo, const Image& normals, float repeats);
  /// Black diffuse surface that emits `radiance` (W/(m2 sr)) from its front.
  int addEmitter(const std::string& name, const glm::vec3& radiance);
  int addMirror(const std::string& name, const glm::vec3& color);
  /// Solid clear glass.
  int addGlass(const std::string& name, float ior);

  int addPlain(const PlainMaterial& material);

  /// A node of its own with a mesh, which must be sound.
  void addMesh(const MeshArrays& mesh);
  /// A punctual light of a file.
  void addLight(const Light& light);
  void addCamera(const Camera& camera);

  /// A node of its own with a mesh, turned by `yAngle` (radians) around +Y, then moved. Returns its index.
  int addObject(const std::string& name, const MeshShape& shape, int material,
                const glm::vec3& translation = glm::vec3(0.0f), double yAngle = 0.0);
  /// The same with the shape's texture coordinates, which it must have.
  int addUnfolded(const std::string& name, const MeshShape& shape, int material,
                  const glm::vec3& translation = glm::vec3(0.0f), double yAngle = 0.0);
  /// A channel of the animation of that name, which the first channel makes.
  void animate(const std::string& animation, int node, AnimatedPath path, const AnimationSampler& sampler);
  /// Point light of `intensity` W/sr.
  void addPointLight(const std::string& name, const glm::vec3& position, const glm::vec3& color,
                     double intensity);
  void addCamera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target, double yFov,
                 double aspect);

  GltfDocument take() { return std::move(document_); }

 private:
  int addMaterial(nlohmann::ordered_json material);
  int addPositions(std::span<const glm::vec3> positions);
  void addMeshNode(nlohmann::ordered_json primitive, nlohmann::ordered_json node);
  void addNode(nlohmann::ordered_json node);
  void useExtension(const std::string& name);

  GltfDocument document_;
};

}  // namespace prelight
