#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "prelight/load.h"
#include "prelight/scene.h"

namespace prelight {

/// A material without textures. The default is a white Lambertian surface.
struct PlainMaterial {
  std::string name = {};
  glm::vec4 baseColor{1.0f};  ///< linear RGB and alpha, 0..1
  float metallic = 0.0f;      ///< 0..1
  float roughness = 1.0f;     ///< 0..1
  float specular = 0.0f;      ///< strength of a dielectric's reflection, 0..1; 0: pure Lambert
  glm::vec3 emission{0.0f};   ///< W/(m2 sr), >= 0
  float transmission = 0.0f;  ///< share of a dielectric that is glass, 0..1
  bool solid = false;         ///< glass with an inside, which refracts
  float ior = 1.5f;           ///< >= 1
  bool doubleSided = false;
};

/// A mesh given by arrays, which are copied.
struct MeshArrays {
  std::string name = {};
  std::span<const glm::vec3> positions;        ///< [vertex], m
  std::span<const glm::uvec3> triangles;       ///< vertex indices; fronts are counter-clockwise
  std::span<const glm::vec3> normals = {};     ///< [vertex], not 0; empty: flat shading
  std::span<const glm::vec2> texCoords = {};   ///< [vertex]; empty: none
  std::span<const glm::vec2> texCoords1 = {};  ///< [vertex], for light maps; requires texCoords
  std::span<const glm::vec4> colors = {};      ///< [vertex], linear RGBA, 0..1; empty: white
  int material = -1;        ///< index into SceneArrays::materials; -1: a default PlainMaterial
  glm::dmat4 toWorld{1.0};  ///< column vectors, affine and invertible
};

/// A scene given by arrays.
struct SceneArrays {
  std::string name = "scene";
  std::vector<MeshArrays> meshes = {};
  std::vector<PlainMaterial> materials = {};
  std::vector<Light> lights = {};  ///< directional, point and spot lights without profile or cookie
  std::vector<Camera> cameras = {};
};

/// Makes a scene from arrays. save() can write it as a .glb like any other. Vertices keep their order. Throws
/// UsageError naming the array and the element for lengths that do not match, indices beyond the vertices,
/// and values that are not finite or out of range.
LoadedScene makeScene(const SceneArrays& arrays);

}  // namespace prelight
