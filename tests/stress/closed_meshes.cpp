#include "stress/closed_meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "stress/rays.h"
#include "support/scenes.h"

namespace prelight::test {

namespace {

using Place = std::tuple<float, float, float>;

// -0 and 0 are the same place.
Place placeOf(const glm::vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

}  // namespace

// Sum of the signed solid angles of the triangles (van Oosterom and Strackee 1983, Eq. 8).
int windings(const CompiledScene& mesh, const glm::dvec3& point) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - point, b = glm::dvec3(mesh.positions[t.y]) - point,
                     c = glm::dvec3(mesh.positions[t.z]) - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return static_cast<int>(std::lround(sum / 3.14159265358979));
}

bool isClosed(const CompiledScene& mesh) {
  std::map<std::pair<Place, Place>, int> balance;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Place a = placeOf(mesh.positions[t[k]]), b = placeOf(mesh.positions[t[(k + 1) % 3]]);
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  for (const auto& [edge, count] : balance)
    if (count != 0) return false;
  return true;
}

namespace {

/// Whether a point is inside by more than rounding. A point nearer to the surface may or may not see it at t
/// = 0.
bool isWellInside(const CompiledScene& mesh, const glm::dvec3& point) {
  const glm::vec3 most = glm::max(glm::abs(mesh.boundsMin), glm::abs(mesh.boundsMax));
  const double rounding = 0x1p-22 * std::max({most.x, most.y, most.z});
  const int around = windings(mesh, point);
  if (around == 0) return false;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-rounding, rounding}) {
      glm::dvec3 beside = point;
      beside[axis] += side;
      if (windings(mesh, beside) != around) return false;
    }
  return true;
}

}  // namespace

namespace {

/// A place behind a triangle, mostly near to it: of thin bodies few others are inside.
glm::vec3 behindATriangle(const CompiledScene& scene, Counter& random) {
  const auto& t = scene.triangles[random.below(scene.triangles.size())];
  const glm::vec3 a = scene.positions[t[0]], b = scene.positions[t[1]], c = scene.positions[t[2]];
  const float root = std::sqrt(random.uniform()), side = random.uniform();
  const glm::dvec3 normal = glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
  const double length = glm::length(normal), depth = std::pow(double(random.uniform()), 4.0);
  if (length == 0.0) return a;
  const double size = glm::length(glm::dvec3(scene.boundsMax - scene.boundsMin));
  const glm::vec3 on = a + root * ((1 - side) * (b - a) + side * (c - a));
  return on - glm::vec3(depth * size / length * normal);
}

}  // namespace

ClosedMesh closedMesh(const std::string& name, const CompiledScene& scene, std::size_t points) {
  ClosedMesh mesh{name, scene, {}};
  EXPECT_TRUE(isClosed(scene)) << name;
  Counter random(1);
  for (int attempt = 0; attempt < 20000 && mesh.inside.size() < points; ++attempt) {
    const glm::vec3 share(random.uniform(), random.uniform(), random.uniform());
    const glm::vec3 p =
        attempt % 2 == 0 ? glm::mix(scene.boundsMin, scene.boundsMax, share) : behindATriangle(scene, random);
    if (isWellInside(scene, glm::dvec3(p))) mesh.inside.push_back(p);
  }
  EXPECT_GE(mesh.inside.size(), points / 4) << name;
  return mesh;
}

CompiledScene torus(int segments, int tubeSegments, float ring, float tube) {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (int s = 0; s < segments; ++s)
    for (int t = 0; t < tubeSegments; ++t) {
      const double around = 6.28318530717959 * s / segments, angle = 6.28318530717959 * t / tubeSegments;
      const double radius = ring + tube * std::cos(angle);
      positions.emplace_back(radius * std::cos(around), tube * std::sin(angle), -radius * std::sin(around));
    }
  const auto vertex = [&](int s, int t) {
    return static_cast<std::uint32_t>((s % segments) * tubeSegments + t % tubeSegments);
  };
  for (int s = 0; s < segments; ++s)
    for (int t = 0; t < tubeSegments; ++t) {
      triangles.emplace_back(vertex(s, t), vertex(s + 1, t), vertex(s, t + 1));
      triangles.emplace_back(vertex(s + 1, t), vertex(s + 1, t + 1), vertex(s, t + 1));
    }
  return sceneOf(std::move(positions), std::move(triangles));
}

CompiledScene withSlivers(const CompiledScene& mesh, float distance) {
  std::vector<glm::vec3> positions = mesh.positions;
  std::vector<glm::uvec3> triangles;
  Counter random(2);
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
    const double along = random.between(0.1f, 0.9f);
    const auto middle = static_cast<std::uint32_t>(positions.size());
    positions.emplace_back(a + along * (b - a) + static_cast<double>(distance) * (c - a));
    triangles.emplace_back(t.x, t.y, middle);
    triangles.emplace_back(t.y, t.z, middle);
    triangles.emplace_back(t.z, t.x, middle);
  }
  return sceneOf(std::move(positions), std::move(triangles));
}

CompiledScene needles(int sides, float height) {
  std::vector<glm::vec3> positions{{0, 0, 0}, {0, height, 0}};
  std::vector<glm::uvec3> triangles;
  for (int i = 0; i < sides; ++i) {
    const double angle = 6.28318530717959 * i / sides;
    for (const float y : {0.0f, height}) positions.emplace_back(std::sin(angle), y, std::cos(angle));
  }
  for (int i = 0; i < sides; ++i) {
    const auto low = static_cast<std::uint32_t>(2 + 2 * i);
    const auto next = static_cast<std::uint32_t>(2 + 2 * ((i + 1) % sides));
    triangles.emplace_back(low, next, next + 1);
    triangles.emplace_back(low, next + 1, low + 1);
    triangles.emplace_back(0, next, low);
    triangles.emplace_back(1, low + 1, next + 1);
  }
  return sceneOf(std::move(positions), std::move(triangles));
}

CompiledScene moved(const CompiledScene& mesh, const glm::vec3& scale, const glm::vec3& offset) {
  std::vector<glm::vec3> positions;
  for (const auto& p : mesh.positions)
    positions.emplace_back(glm::dvec3(scale) * glm::dvec3(p) + glm::dvec3(offset));
  return sceneOf(std::move(positions), mesh.triangles);
}

Scene builtinScene(const std::string& name, const glm::dmat4& transform) {
  Warnings warnings;
  Scene scene = loadScene(makeBuiltinScene(name), warnings);
  for (auto& node : scene.meshNodes)
    for (auto& m : node.transforms) m = transform * m;
  return scene;
}

std::vector<ClosedMesh> closedObjectsOfBuiltinScenes(const glm::dmat4& transform) {
  constexpr std::size_t pointsOfEach = 32;  // of many meshes, which share the rays
  std::vector<ClosedMesh> meshes;
  for (const auto& builtin : builtinScenes()) {
    Scene scene = builtinScene(builtin.name, transform);
    for (const auto& node : std::exchange(scene.meshNodes, {})) {
      scene.meshNodes = {node};
      Warnings warnings;
      const CompiledScene compiled = compileScene(scene, warnings);
      if (isClosed(compiled))
        meshes.push_back(closedMesh(builtin.name + "/" + node.name, compiled, pointsOfEach));
    }
  }
  return meshes;
}

device::Ray aimedRay(const ClosedMesh& mesh, std::uint64_t index, std::uint64_t seed) {
  Counter random(seed + (index << 8));
  const std::uint64_t group = (index >> 10) % 2 == 0 ? index : index >> 4;
  const glm::vec3 from = mesh.inside[Counter(seed + (group << 8)).below(mesh.inside.size())];
  const auto& t = mesh.scene.triangles[random.below(mesh.scene.triangles.size())];
  const int first = static_cast<int>(random.below(3));
  const glm::vec3 a = mesh.scene.positions[t[first]], b = mesh.scene.positions[t[(first + 1) % 3]],
                  c = mesh.scene.positions[t[(first + 2) % 3]];
  const float u = random.uniform(), v = random.uniform();
  const std::uint64_t kind = random.below(16);
  const glm::vec3 target =
      kind < 6 ? a : (kind < 14 ? a + u * (b - a) : a + u * ((1 - v) * (b - a) + v * (c - a)));
  const glm::vec3 direction = target - from;
  // Normalised directions miss their target by rounding, as directions do in practice.
  return makeRay(from, kind % 2 == 0 ? direction : glm::normalize(direction));
}

}  // namespace prelight::test
