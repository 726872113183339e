#include "prelight/make_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "library/open_scene.h"
#include "prelight/error.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight {

namespace {

template <typename Vector>
std::string textOf(const Vector& v) {
  std::string text;
  for (int i = 0; i < v.length(); ++i) text += fmt::format("{}{:g}", i == 0 ? "(" : ", ", v[i]);
  return text + ")";
}

template <typename Vector>
bool isFinite(const Vector& v) {
  for (int i = 0; i < v.length(); ++i)
    if (!std::isfinite(v[i])) return false;
  return true;
}

/// Throws unless the array is empty or has a finite element for each vertex.
template <typename Vector>
void requireAttribute(const std::string& mesh, const char* name, std::span<const Vector> values,
                      std::size_t vertices) {
  if (values.empty()) return;
  const std::string where = fmt::format("{}: {}", mesh, name);
  if (values.size() != vertices)
    throw UsageError(where,
                     fmt::format("got {} elements, expected one per vertex: {}", values.size(), vertices));
  for (std::size_t v = 0; v < values.size(); ++v)
    if (!isFinite(values[v]))
      throw UsageError(where, fmt::format("element {} is {}, expected finite numbers", v, textOf(values[v])));
}

void requireTransform(const std::string& mesh, const glm::dmat4& matrix) {
  bool sound = glm::transpose(matrix)[3] == glm::dvec4(0.0, 0.0, 0.0, 1.0);
  for (int column = 0; column < 4; ++column) sound = sound && isFinite(matrix[column]);
  if (!sound || !(std::abs(glm::determinant(glm::dmat3(matrix))) > 0.0))
    throw UsageError(mesh + ": toWorld", "expected a finite affine matrix that can be inverted",
                     "its last row is 0, 0, 0, 1; translations stand in its last column");
}

void requireMesh(const MeshArrays& mesh, std::size_t index, std::size_t materials) {
  const std::string where =
      mesh.name.empty() ? fmt::format("mesh {}", index) : fmt::format("mesh {} \"{}\"", index, mesh.name);
  const std::size_t vertices = mesh.positions.size();
  if (vertices == 0 || mesh.triangles.empty())
    throw UsageError(where, fmt::format("got {} vertices and {} triangles, expected at least one of each",
                                        vertices, mesh.triangles.size()));
  requireAttribute(where, "positions", mesh.positions, vertices);
  requireAttribute(where, "normals", mesh.normals, vertices);
  requireAttribute(where, "texCoords", mesh.texCoords, vertices);
  requireAttribute(where, "texCoords1", mesh.texCoords1, vertices);
  requireAttribute(where, "colors", mesh.colors, vertices);
  if (!mesh.texCoords1.empty() && mesh.texCoords.empty())
    throw UsageError(where + ": texCoords1", "texCoords are missing", "give the first set, too");
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    if (mesh.normals[v] == glm::vec3(0.0f))
      throw UsageError(where + ": normals", fmt::format("element {} is 0, expected a direction", v));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      if (mesh.triangles[t][corner] >= vertices)
        throw UsageError(where + ": triangles",
                         fmt::format("triangle {} has vertex {}, expected one below {}", t,
                                     mesh.triangles[t][corner], vertices));
  if (mesh.material < -1 || mesh.material >= static_cast<int>(materials))
    throw UsageError(where + ": material",
                     fmt::format("got {}, expected -1 or one of {} materials", mesh.material, materials));
  requireTransform(where, mesh.toWorld);
}

void requireMaterial(const PlainMaterial& material, std::size_t index) {
  const std::string where = fmt::format("material {}", index);
  const auto requireRange = [&](const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw UsageError(fmt::format("{}: {}", where, name),
                       fmt::format("got {:g}, expected {:g} to {:g}", value, least, most));
  };
  for (int i = 0; i < 4; ++i) requireRange("baseColor", material.baseColor[i], 0.0, 1.0);
  requireRange("metallic", material.metallic, 0.0, 1.0);
  requireRange("roughness", material.roughness, 0.0, 1.0);
  requireRange("specular", material.specular, 0.0, 1.0);
  for (int c = 0; c < 3; ++c) requireRange("emission", material.emission[c], 0.0, 1e9);
  requireRange("transmission", material.transmission, 0.0, 1.0);
  requireRange("ior", material.ior, 1.0, 100.0);
}

void requireLight(const Light& light, std::size_t index) {
  const std::string where = fmt::format("light {}", index);
  if (light.type == LightType::Area || light.profile || light.cookie)
    throw UsageError(where, "files cannot hold area lights, profiles or cookies in this form",
                     "give area lights as emissive meshes");
  for (int c = 0; c < 3; ++c)
    if (!(light.intensity[c] >= 0.0f) || !std::isfinite(light.intensity[c]))
      throw UsageError(where + ": intensity",
                       fmt::format("got {}, expected finite numbers >= 0", textOf(light.intensity)));
  if (!isFinite(light.position))
    throw UsageError(where + ": position",
                     fmt::format("got {}, expected finite numbers", textOf(light.position)));
  if (!(std::abs(glm::length(light.direction) - 1.0) < 1e-5))
    throw UsageError(where + ": direction",
                     fmt::format("got {}, expected a unit vector", textOf(light.direction)));
  if (!(light.range >= 0.0f) || !std::isfinite(light.range))
    throw UsageError(where + ": range", fmt::format("got {:g}, expected 0 or a distance", light.range));
  constexpr float mostAngle = 1.57079633f;
  if (!(light.radius >= 0.0f) || !std::isfinite(light.radius) ||
      (light.type == LightType::Directional && light.radius > mostAngle))
    throw UsageError(where + ": radius",
                     fmt::format("got {:g}, expected 0, metres, or at most pi/2 rad of a directional light",
                                 light.radius));
  if (light.type == LightType::Spot &&
      !(light.innerConeAngle >= 0.0f && light.innerConeAngle < light.outerConeAngle &&
        light.outerConeAngle <= mostAngle))
    throw UsageError(where + ": outerConeAngle",
                     fmt::format("got cones of {:g} and {:g} rad, expected 0 <= inner < outer <= pi/2",
                                 light.innerConeAngle, light.outerConeAngle));
}

void requireCamera(const Camera& camera, std::size_t index) {
  const std::string where = fmt::format("camera {}", index);
  for (int column = 0; column < 4; ++column)
    if (!isFinite(camera.world[column])) throw UsageError(where + ": world", "expected finite numbers");
  if (camera.perspective && !(camera.yFov > 0.0 && camera.yFov < 3.14159))
    throw UsageError(where + ": yFov", fmt::format("got {:g} rad, expected 0 to pi", camera.yFov));
}

/// Returns normalised normals, as files require them.
std::vector<glm::vec3> unitOf(std::span<const glm::vec3> normals) {
  std::vector<glm::vec3> units;
  units.reserve(normals.size());
  for (const glm::vec3& normal : normals) units.emplace_back(glm::normalize(glm::dvec3(normal)));
  return units;
}

}  // namespace

LoadedScene makeScene(const SceneArrays& arrays) {
  for (std::size_t i = 0; i < arrays.materials.size(); ++i) requireMaterial(arrays.materials[i], i);
  for (std::size_t i = 0; i < arrays.meshes.size(); ++i)
    requireMesh(arrays.meshes[i], i, arrays.materials.size());
  for (std::size_t i = 0; i < arrays.lights.size(); ++i) requireLight(arrays.lights[i], i);
  for (std::size_t i = 0; i < arrays.cameras.size(); ++i) requireCamera(arrays.cameras[i], i);
  return loadDocument(
      [&](Warnings&) {
        GltfBuilder builder(arrays.name);
        for (const PlainMaterial& material : arrays.materials) builder.addPlain(material);
        int plain = -1;  // material of meshes without one
        for (MeshArrays mesh : arrays.meshes) {
          const std::vector<glm::vec3> normals = unitOf(mesh.normals);
          mesh.normals = normals;
          if (mesh.material < 0) mesh.material = plain = plain < 0 ? builder.addPlain({}) : plain;
          builder.addMesh(mesh);
        }
        for (const Light& light : arrays.lights) builder.addLight(light);
        for (const Camera& camera : arrays.cameras) builder.addCamera(camera);
        return builder.take();
      },
      {});
}

}  // namespace prelight
