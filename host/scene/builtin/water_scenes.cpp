#include "scene/builtin/water_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "scene/builtin/gltf_builder.h"

namespace prelight {
namespace {

/// A height in metres over x and z.
using Height = std::function<double(double x, double z)>;

/// Returns a grid of cells x cells quads over x and z in [-half, half] at these heights.
MeshShape makeField(double half, int cells, const Height& height) {
  MeshShape field =
      makeGrid({-half, 0.0, half}, {2.0 * half, 0.0, 0.0}, {0.0, 0.0, -2.0 * half}, cells, cells);
  constexpr double step = 1e-3;
  for (std::size_t i = 0; i < field.positions.size(); ++i) {
    const double x = field.positions[i].x, z = field.positions[i].z;
    field.positions[i].y = static_cast<float>(height(x, z));
    field.normals[i] = glm::normalize(glm::dvec3(height(x - step, z) - height(x + step, z), 2.0 * step,
                                                 height(x, z - step) - height(x, z + step)));
  }
  return field;
}

/// Returns a rock: a ball that is flattened and dented.
MeshShape makeRock(float radius, double phase) {
  MeshShape rock = makeSphere(radius, 28, 20);
  const auto dented = [&](const glm::vec3& p) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(p) - glm::dvec3(0.0, radius, 0.0));
    const double dent = 1.0 + 0.13 * std::sin(5.0 * way.x + phase) * std::cos(4.0 * way.z - 2.0 * phase);
    return glm::vec3(way * dent * static_cast<double>(radius) * glm::dvec3(1.2, 0.65, 0.9));
  };
  for (glm::vec3& position : rock.positions) position = dented(position);
  for (glm::vec3& normal : rock.normals) normal = glm::vec3(0.0f);
  for (const glm::uvec3& t : rock.triangles) {
    const glm::vec3 normal =
        glm::cross(rock.positions[t.y] - rock.positions[t.x], rock.positions[t.z] - rock.positions[t.x]);
    for (int corner = 0; corner < 3; ++corner) rock.normals[t[corner]] += normal;
  }
  for (glm::vec3& normal : rock.normals) normal = glm::normalize(normal);
  return rock;
}

/// Adds branches of coral that stand around a place.
void addCoral(const glm::vec3& place, int material, GltfBuilder& builder) {
  constexpr int branches = 6;
  for (int i = 0; i < branches; ++i) {
    const double angle = 2.4 * i, radius = 0.1 * std::sqrt(i);
    const float height = 1.0f - 0.11f * static_cast<float>(i);
    builder.addObject("Coral " + std::to_string(i), makeCone(0.1f, height, 16, 8, 2), material,
                      place + glm::vec3(radius * std::cos(angle), 0.0, radius * std::sin(angle)));
  }
}

/// Returns a floor of dunes with a reef that rises around it.
double seaFloor(double x, double z) {
  const double dunes = 0.09 * std::sin(1.3 * x + 0.7 * z) + 0.05 * std::sin(2.9 * z - 0.8 * x + 1.0) + 0.14;
  const double beyond = std::max(0.0, std::hypot(x, z) - 3.0 - 0.3 * std::sin(3.0 * std::atan2(z, x)));
  return dunes + 0.3 * beyond * beyond;
}

/// Returns a basin around the origin whose shore rises beyond 2.6 m.
double lakeBed(double x, double z) {
  const double radius = std::hypot(x, 1.25 * z), angle = std::atan2(z, x);
  const double bays = 0.22 * std::sin(3.0 * angle + 0.5) + 0.12 * std::sin(7.0 * angle);
  const double rim = radius - 2.6 - bays * std::min(radius * radius, 1.0);  // smooth at the origin
  const double rise = rim > 0.0 ? 0.9 * (1.0 - std::exp(-0.9 * rim)) : 0.75 * std::tanh(rim);
  return rise + 0.04 * std::sin(3.0 * x) * std::cos(2.6 * z);
}

}  // namespace

GltfDocument makeOceanScene() {
  GltfBuilder builder("ocean");
  builder.addObject("Sea floor", makeField(4.8, 104, seaFloor),
                    builder.addDiffuse("Sand", {0.62f, 0.6f, 0.48f}));
  const int stone = builder.addDiffuse("Stone", {0.3f, 0.33f, 0.36f});
  builder.addObject("Rock 0", makeRock(0.75f, 0.3), stone, {-2.1f, 0.35f, -0.9f}, 0.4);
  builder.addObject("Rock 1", makeRock(0.45f, 1.7), stone, {-1.1f, 0.25f, -1.8f}, 1.3);
  builder.addObject("Rock 2", makeRock(0.55f, 2.9), stone, {2.2f, 0.3f, 0.9f}, 2.2);
  builder.addObject(
      "Pearl", makeSphere(0.5f, 40, 28),
      builder.addPlain(
          {.name = "Pearl", .baseColor = {0.02f, 0.02f, 0.025f, 1.0f}, .roughness = 0.15f, .specular = 1.0f}),
      {0.1f, 0.2f, 0.6f});
  addCoral({1.5f, 0.1f, -1.2f}, builder.addDiffuse("Coral", {0.8f, 0.25f, 0.18f}), builder);
  constexpr double level = 3.4, half = 4.8;
  builder.addObject("Water",
                    makeGrid({-half, level, half}, {2.0 * half, 0.0, 0.0}, {0.0, 0.0, -2.0 * half}, 32, 32),
                    builder.addGlass("Water", 1.33f));
  constexpr int lights = 8;
  for (int i = 0; i < lights; ++i) {
    const double angle = 2.4 * i, radius = 0.95 * std::sqrt(i + 0.5);
    const float warm = static_cast<float>(i % 3) / 2.0f;
    builder.addPointLight("Light " + std::to_string(i),
                          {radius * std::cos(angle), level + 0.4 + 0.1 * (i % 4), radius * std::sin(angle)},
                          glm::mix(glm::vec3(0.45f, 0.85f, 1.0f), glm::vec3(1.0f, 0.95f, 0.7f), warm), 5.0);
  }
  builder.addCamera("Camera", {0.2, 3.1, 4.3}, {0.0, 0.05, 0.1}, 0.75, 4.0 / 3.0);
  return builder.take();
}

GltfDocument makeLakeScene() {
  GltfBuilder builder("lake");
  // The vertices of the bed are close, because waves bend the normals of vertices.
  builder.addObject("Bed", makeField(4.6, 112, lakeBed), builder.addDiffuse("Earth", {0.5f, 0.36f, 0.25f}));
  const int stone = builder.addDiffuse("Stone", {0.35f, 0.32f, 0.3f});
  builder.addObject("Rock 0", makeRock(0.6f, 0.8), stone, {-1.5f, 0.0f, -1.0f}, 0.7);
  builder.addObject("Rock 1", makeRock(0.4f, 2.1), stone, {1.6f, -0.05f, 0.5f}, 1.9);
  builder.addObject("Water", makeGrid({-3.4, 0.0, 2.9}, {6.8, 0.0, 0.0}, {0.0, 0.0, -5.8}, 34, 29),
                    builder.addGlass("Water", 1.33f));
  builder.addPointLight("Light 0", {0.9f, 1.5f, -1.6f}, {1.0f, 0.55f, 0.2f}, 5.0);
  builder.addPointLight("Light 1", {-0.9f, 1.2f, 0.6f}, {1.0f, 0.4f, 0.12f}, 4.0);
  builder.addPointLight("Light 2", {1.3f, 1.3f, 1.0f}, {1.0f, 0.6f, 0.25f}, 4.0);
  builder.addCamera("Camera", {0.0, 2.9, 4.2}, {0.0, -0.2, 0.0}, 0.75, 4.0 / 3.0);
  return builder.take();
}

}  // namespace prelight
