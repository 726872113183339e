#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "prelight/load.h"
#include "prelight/make_scene.h"
#include "support/scenes.h"

namespace prelight::test {

/// Builds a scene of meshes, lamps and cameras as makeScene() does, all moved by one transform.
class SceneMaker {
 public:
  explicit SceneMaker(const glm::dmat4& place = glm::dmat4(1.0)) : place_(place) {
    arrays_.materials.resize(3);
    arrays_.materials[twoSided].doubleSided = true;
    arrays_.materials[glowing].emission = glm::vec3(5.0f);
  }

  static constexpr int oneSided = 0, twoSided = 1, glowing = 2;  ///< Material indices.

  /// Adds the triangles of a scene of support/scenes.h. Without normals it is flat.
  SceneMaker& add(const std::string& name, const CompiledScene& mesh, int material = oneSided,
                  bool normals = true);

  SceneMaker& addLamp(const glm::dvec3& position);
  SceneMaker& addSun(const glm::dvec3& direction);
  SceneMaker& addCamera(const glm::dvec3& eye);

  LoadedScene make() const;

 private:
  glm::dmat4 place_;
  SceneArrays arrays_;
  std::vector<CompiledScene> meshes_;
  std::vector<bool> hasNormals_;
};

/// The triangles of several meshes in one mesh.
CompiledScene joined(const std::vector<CompiledScene>& meshes);

/// The mesh with its triangles wound the other way and its normals unchanged.
CompiledScene woundBack(CompiledScene mesh);

/// The mesh with its normals inverted and its triangles wound as before.
CompiledScene withNormalsInverted(CompiledScene mesh);

}  // namespace prelight::test
