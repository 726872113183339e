#include "support/scenes.h"

#include <array>
#include <cmath>

namespace prelight::test {

namespace {

void updateDerived(CompiledScene& scene) {
  scene.boundsMin = glm::vec3(1e30f);
  scene.boundsMax = glm::vec3(-1e30f);
  for (const auto& p : scene.positions) {
    scene.boundsMin = glm::min(scene.boundsMin, p);
    scene.boundsMax = glm::max(scene.boundsMax, p);
  }
  std::vector<glm::dvec3> sums(scene.positions.size(), glm::dvec3(0));
  for (const auto& t : scene.triangles) {
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    for (int k = 0; k < 3; ++k) sums[t[k]] += glm::cross(b - a, c - a);
  }
  scene.normals.resize(scene.positions.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    scene.normals[i] = glm::length(sums[i]) > 0 ? glm::vec3(glm::normalize(sums[i])) : glm::vec3(0, 1, 0);
}

}  // namespace

CompiledScene sceneOf(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles, float albedo) {
  CompiledScene scene;
  scene.positions = std::move(positions);
  scene.triangles = std::move(triangles);
  scene.texCoords.assign(scene.positions.size(), glm::vec2(0));
  scene.triangleMaterials.assign(scene.triangles.size(), 0);
  scene.triangleFlat.assign(scene.triangles.size(), 0);
  scene.materials.resize(1);
  scene.materials[0].albedo = glm::vec3(albedo);
  scene.primitives = {{0, 0, 0, 0, scene.vertexCount(), 0, scene.triangleCount()}};
  updateDerived(scene);
  return scene;
}

void append(CompiledScene& scene, const CompiledScene& other) {
  const auto vertex = scene.vertexCount();
  const auto triangle = scene.triangleCount();
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  scene.positions.insert(scene.positions.end(), other.positions.begin(), other.positions.end());
  scene.texCoords.insert(scene.texCoords.end(), other.texCoords.begin(), other.texCoords.end());
  for (const auto& t : other.triangles) scene.triangles.push_back(t + vertex);
  for (const auto m : other.triangleMaterials) scene.triangleMaterials.push_back(m + material);
  scene.triangleFlat.insert(scene.triangleFlat.end(), other.triangleFlat.begin(), other.triangleFlat.end());
  scene.materials.insert(scene.materials.end(), other.materials.begin(), other.materials.end());
  scene.primitives.push_back({static_cast<int>(scene.primitives.size()), 0, 0, vertex, other.vertexCount(),
                              triangle, other.triangleCount()});
  updateDerived(scene);
}

CompiledScene randomSoup(std::size_t triangles, float size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> indices;
  for (std::size_t i = 0; i < triangles; ++i) {
    const glm::vec3 centre(unit(random), unit(random), unit(random));
    for (int k = 0; k < 3; ++k) positions.push_back(centre + size * randomDirection(random) * unit(random));
    const auto first = static_cast<std::uint32_t>(3 * i);
    indices.push_back({first, first + 1, first + 2});
  }
  return sceneOf(std::move(positions), std::move(indices));
}

CompiledScene sphere(int segments, float radius, const glm::vec3& centre) {
  std::vector<glm::vec3> positions{centre + glm::vec3(0, radius, 0)};
  std::vector<glm::uvec3> triangles;
  const int around = 2 * segments;
  for (int j = 1; j < segments; ++j)
    for (int i = 0; i < around; ++i) {
      const double theta = 3.14159265358979 * j / segments, phi = 6.28318530717959 * i / around;
      positions.push_back(centre + radius * glm::vec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                                      std::sin(theta) * std::cos(phi)));
    }
  positions.push_back(centre - glm::vec3(0, radius, 0));
  const auto ring = [&](int j, int i) {
    return static_cast<std::uint32_t>(1 + (j - 1) * around + i % around);
  };
  const auto last = static_cast<std::uint32_t>(positions.size() - 1);
  for (int i = 0; i < around; ++i) {
    triangles.push_back({0, ring(1, i), ring(1, i + 1)});
    for (int j = 1; j + 1 < segments; ++j) {
      triangles.push_back({ring(j, i), ring(j + 1, i), ring(j + 1, i + 1)});
      triangles.push_back({ring(j, i), ring(j + 1, i + 1), ring(j, i + 1)});
    }
    triangles.push_back({ring(segments - 1, i), last, ring(segments - 1, i + 1)});
  }
  return sceneOf(std::move(positions), std::move(triangles));
}

namespace {

/// Adds a grid of quads over origin + [0,1] a + [0,1] b, facing cross(a, b).
void addGrid(std::vector<glm::vec3>& positions, std::vector<glm::uvec3>& triangles, int cells,
             const glm::vec3& origin, const glm::vec3& a, const glm::vec3& b) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  const auto side = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i)
      positions.push_back(origin + a * (static_cast<float>(i) / static_cast<float>(cells)) +
                          b * (static_cast<float>(j) / static_cast<float>(cells)));
  for (std::uint32_t j = 0; j + 1 < side; ++j)
    for (std::uint32_t i = 0; i + 1 < side; ++i) {
      const std::uint32_t v = first + j * side + i;
      triangles.push_back({v, v + 1, v + side + 1});
      triangles.push_back({v, v + side + 1, v + side});
    }
}

}  // namespace

CompiledScene ground(int cells, float half, float height) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  addGrid(positions, triangles, cells, {-half, height, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
  return sceneOf(std::move(positions), std::move(triangles));
}

CompiledScene box(int cells, const glm::vec3& lower, const glm::vec3& upper, bool inward) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  const glm::vec3 d = upper - lower;
  const std::array<glm::vec3, 3> edge{glm::vec3(d.x, 0, 0), glm::vec3(0, d.y, 0), glm::vec3(0, 0, d.z)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const glm::vec3 a = edge[(axis + 1) % 3], b = edge[(axis + 2) % 3];
    // cross(a, b) points along +axis: outwards on the upper face, inwards on the lower one.
    addGrid(positions, triangles, cells, lower + edge[axis], inward ? b : a, inward ? a : b);
    addGrid(positions, triangles, cells, lower, inward ? a : b, inward ? b : a);
  }
  return sceneOf(std::move(positions), std::move(triangles));
}

const std::vector<Image>& noImages() {
  static const std::vector<Image> none;
  return none;
}

glm::vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<float> normal;
  for (;;) {
    const glm::vec3 v(normal(random), normal(random), normal(random));
    if (glm::length(v) > 1e-3f) return glm::normalize(v);
  }
}

}  // namespace prelight::test
