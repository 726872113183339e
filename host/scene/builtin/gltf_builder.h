#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "prelight/make_scene.h"
#include "prelight/scene.h"
#include "scene/builtin/mesh_shapes.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Indices of a document's textures; -1: none.
struct MapIndices {
  int albedo = -1;
  int roughness = -1;
  int normals = -1;
};

/// Builds a glTF document part by part. All parts are named; every node is a root of the only scene. The add
/// functions return the index of what they add.
class GltfBuilder {
 public:
  explicit GltfBuilder(const std::string& sceneName);

  /// Adds an untextured Lambertian material: no metal, no specular. `albedo` is linear.
  int addDiffuse(const std::string& name, const glm::vec3& albedo);
  /// Adds a diffuse material with a normal map that repeats `repeats` times along each texture coordinate.
  int addBumpy(const std::string& name, const glm::vec3& albedo, const Image& normals, float repeats);
  /// Adds a black diffuse material that emits `radiance` (W/(m2 sr)) from its front.
  int addEmitter(const std::string& name, const glm::vec3& radiance);
  int addMirror(const std::string& name, const glm::vec3& color);
  /// Adds solid clear glass.
  int addGlass(const std::string& name, float ior);

  int addPlain(const PlainMaterial& material);

  /// Adds images as textures, which several materials may share.
  MapIndices addMaps(const Image& albedo, const Image& roughness, const Image& normals);
  /// Adds a plain material whose base colour and roughness textures multiply.
  int addMapped(const PlainMaterial& material, const MapIndices& maps);
  /// Gives a material fibres that scatter light, as on cloth.
  void addSheen(int material, const glm::vec3& color, float roughness);

  /// Adds a node with a mesh, which must be valid.
  void addMesh(const MeshArrays& mesh);
  /// Adds a punctual light as files describe it.
  void addLight(const Light& light);
  void addCamera(const Camera& camera);

  /// Adds a node with a mesh, rotated by `yAngle` (radians) around +Y, then moved by `translation`. Returns
  /// the node's index.
  int addObject(const std::string& name, const MeshShape& shape, int material,
                const glm::vec3& translation = glm::vec3(0.0f), double yAngle = 0.0);
  /// As addObject, with the shape's texture coordinates, which it must have.
  int addUnfolded(const std::string& name, const MeshShape& shape, int material,
                  const glm::vec3& translation = glm::vec3(0.0f), double yAngle = 0.0);
  /// Adds a channel to the animation of that name, and creates the animation if it is new.
  void animate(const std::string& animation, int node, AnimatedPath path, const AnimationSampler& sampler);
  /// Adds a point light of `intensity` W/sr.
  void addPointLight(const std::string& name, const glm::vec3& position, const glm::vec3& color,
                     double intensity);
  void addCamera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target, double yFov,
                 double aspect);

  GltfDocument take() { return std::move(document_); }

 private:
  int addMaterial(nlohmann::ordered_json material);
  int addTexture(const Image& image);
  int addPositions(std::span<const glm::vec3> positions);
  void addMeshNode(nlohmann::ordered_json primitive, nlohmann::ordered_json node);
  void addNode(nlohmann::ordered_json node);
  void useExtension(const std::string& name);

  GltfDocument document_;
};

}  // namespace prelight
