#include "support/made_scenes.h"

#include <utility>

namespace prelight::test {

SceneMaker& SceneMaker::add(const std::string& name, const CompiledScene& mesh, int material, bool normals) {
  MeshArrays arrays;
  arrays.name = name;
  arrays.material = material;
  arrays_.meshes.push_back(arrays);
  meshes_.push_back(mesh);
  hasNormals_.push_back(normals);
  return *this;
}

SceneMaker& SceneMaker::addLamp(const glm::dvec3& position) {
  Light lamp;
  lamp.name = "Lamp";
  lamp.intensity = glm::vec3(10.0f);
  lamp.position = glm::dvec3(place_ * glm::dvec4(position, 1.0));
  arrays_.lights.push_back(lamp);
  return *this;
}

SceneMaker& SceneMaker::addSun(const glm::dvec3& direction) {
  Light sun;
  sun.name = "Sun";
  sun.type = LightType::Directional;
  sun.direction = glm::normalize(glm::dmat3(place_) * direction);
  arrays_.lights.push_back(sun);
  return *this;
}

SceneMaker& SceneMaker::addCamera(const glm::dvec3& eye) {
  Camera camera;
  camera.world[3] = place_ * glm::dvec4(eye, 1.0);
  arrays_.cameras.push_back(camera);
  return *this;
}

LoadedScene SceneMaker::make() const {
  SceneArrays arrays = arrays_;
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    arrays.meshes[i].positions = meshes_[i].positions;
    arrays.meshes[i].triangles = meshes_[i].triangles;
    if (hasNormals_[i]) arrays.meshes[i].normals = meshes_[i].normals;
    arrays.meshes[i].toWorld = place_;
  }
  return makeScene(arrays);
}

CompiledScene joined(const std::vector<CompiledScene>& meshes) {
  CompiledScene all = meshes.front();
  for (std::size_t i = 1; i < meshes.size(); ++i) append(all, meshes[i]);
  return all;
}

CompiledScene woundBack(CompiledScene mesh) {
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
  return mesh;
}

CompiledScene withNormalsInverted(CompiledScene mesh) {
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  return mesh;
}

}  // namespace prelight::test
