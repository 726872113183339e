#include "benchmarks/suites/stability/cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

namespace prelight::benchmarks::stability {

namespace {

/// Returns the scene compiled like that of a file, so that it is moved to its centre in double precision.
CompiledScene compiledOf(std::vector<Primitive> primitives, const std::vector<Material>& materials,
                         const glm::dvec3& offset) {
  Scene scene;
  scene.materials = materials;
  scene.meshes.push_back({"shape", std::move(primitives)});
  SceneNode node;
  node.translation = offset;
  scene.nodes.push_back(node);
  scene.meshNodes.push_back({0, "shape", 0, {glm::translate(glm::dmat4(1.0), offset)}, 0});
  Warnings warnings;
  return compileScene(scene, warnings);
}

CompiledScene compiledOf(Primitive primitive, const Material& material, const glm::dvec3& offset) {
  primitive.material = 0;
  return compiledOf(std::vector<Primitive>{std::move(primitive)}, {material}, offset);
}

/// Adds quads over origin + [0,1] a + [0,1] b, facing cross(a, b).
void addGrid(Primitive& primitive, int cells, const glm::dvec3& origin, const glm::dvec3& a,
             const glm::dvec3& b) {
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  const auto side = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i)
      primitive.positions.emplace_back(origin + a * (double(i) / cells) + b * (double(j) / cells));
  for (std::uint32_t j = 0; j + 1 < side; ++j)
    for (std::uint32_t i = 0; i + 1 < side; ++i) {
      const std::uint32_t v = first + j * side + i;
      primitive.triangles.emplace_back(v, v + 1, v + side + 1);
      primitive.triangles.emplace_back(v, v + side + 1, v + side);
    }
}

}  // namespace

Material matte(double albedo, double emission) {
  Material material;
  material.baseColor = glm::vec4(glm::vec3(static_cast<float>(albedo)), 1.0f);
  material.metallic = 0.0f;
  material.specular = 0.0f;
  material.emission = glm::vec3(static_cast<float>(emission));
  return material;
}

CompiledScene floorScene(double half, int cells, const Material& material, const glm::dvec3& offset) {
  Primitive primitive;
  addGrid(primitive, cells, {-half, 0.0, -half}, {0.0, 0.0, 2.0 * half}, {2.0 * half, 0.0, 0.0});
  return compiledOf(std::move(primitive), material, offset);
}

CompiledScene stackScene(double half, const std::vector<Sheet>& sheets) {
  std::vector<Primitive> primitives;
  std::vector<Material> materials;
  for (const Sheet& sheet : sheets) {
    const glm::dvec3 along(0.0, 0.0, 2.0 * half), across(2.0 * half, 0.0, 0.0);
    Primitive& primitive = primitives.emplace_back();
    addGrid(primitive, 1, {-half, sheet.height, -half}, sheet.facesDown ? across : along,
            sheet.facesDown ? along : across);
    primitive.material = static_cast<int>(materials.size());
    materials.push_back(sheet.material);
  }
  return compiledOf(std::move(primitives), materials, glm::dvec3(0.0));
}

CompiledScene roomScene(double half, int cells, const Material& material, const glm::dvec3& offset) {
  Primitive primitive;
  const glm::dvec3 lower(-half);
  const std::array<glm::dvec3, 3> edge{glm::dvec3(2.0 * half, 0, 0), glm::dvec3(0, 2.0 * half, 0),
                                       glm::dvec3(0, 0, 2.0 * half)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const glm::dvec3 a = edge[(axis + 1) % 3], b = edge[(axis + 2) % 3];
    addGrid(primitive, cells, lower, a, b);
    addGrid(primitive, cells, lower + edge[axis], b, a);
  }
  return compiledOf(std::move(primitive), material, offset);
}

CompiledScene hollowSphere(double radius, int steps, const Material& material) {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<glm::dvec3> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                                    {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                                    {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  std::vector<glm::uvec3> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                   {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                   {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                   {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int step = 0; step < steps; ++step) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (fresh) points.push_back(0.5 * (glm::normalize(points[a]) + glm::normalize(points[b])));
      return place->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& f : faces) {
      const std::uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
    }
    faces = std::move(finer);
  }
  Primitive primitive;
  for (const glm::dvec3& p : points) primitive.positions.emplace_back(radius * glm::normalize(p));
  for (const glm::uvec3& f : faces) primitive.triangles.emplace_back(f.x, f.z, f.y);
  return compiledOf(std::move(primitive), material, glm::dvec3(0.0));
}

Light pointLight(const glm::dvec3& position, double intensity) {
  Light light;
  light.position = position;
  light.intensity = glm::vec3(static_cast<float>(intensity));
  return light;
}

Light farLight(const glm::dvec3& direction, double irradiance) {
  Light light;
  light.type = LightType::Directional;
  light.direction = glm::normalize(direction);
  light.intensity = glm::vec3(static_cast<float>(irradiance));
  return light;
}

Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double yFov) {
  const glm::dvec3 way = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(way.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  Camera camera;
  camera.world = glm::inverse(glm::lookAtRH(eye, target, up));
  camera.yFov = yFov;
  camera.zNear = 1e-6 * glm::length(target - eye);
  return camera;
}

const std::vector<Image>& noImages() {
  static const std::vector<Image> none;
  return none;
}

}  // namespace prelight::benchmarks::stability
