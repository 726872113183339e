#include "benchmarks/suites/bake/bumpy_balls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/scenes/displacement.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight::benchmarks {

namespace {

constexpr int rows = 5;
constexpr double spacing = 1.4;  // metres
constexpr float radius = 0.55f;
constexpr double bump = 0.03;         // twice as much would fold the surface
constexpr double shareOfFloor = 0.1;  // of the triangles
constexpr float lift = 0.01f;         // of balls, so that none reaches below the floor

/// Area-weighted means of the triangles' normals.
void smoothNormals(MeshShape& shape) {
  std::vector<glm::dvec3> sums(shape.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : shape.triangles) {
    const glm::dvec3 p(shape.positions[t.x]), q(shape.positions[t.y]), r(shape.positions[t.z]);
    const glm::dvec3 normal = glm::cross(q - p, r - p);
    sums[t.x] += normal, sums[t.y] += normal, sums[t.z] += normal;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) shape.normals[v] = glm::vec3(glm::normalize(sums[v]));
}

/// Stands on y = 0 around the y axis.
MeshShape makeBall(int segments, int index) {
  MeshShape ball = makeSphere(radius, segments, segments / 2);
  displace(ball, bump, 4.0, 1.0 + index);
  smoothNormals(ball);
  float low = ball.positions.front().y;
  for (const glm::vec3& p : ball.positions) low = std::min(low, p.y);
  for (glm::vec3& p : ball.positions) p.y -= low;
  return ball;
}

}  // namespace

GltfDocument makeBumpyBalls(std::uint64_t triangles) {
  constexpr int balls = rows * rows;
  constexpr std::array<glm::vec3, 4> albedos = {
      {{0.75f, 0.2f, 0.15f}, {0.2f, 0.6f, 0.25f}, {0.2f, 0.3f, 0.75f}, {0.8f, 0.7f, 0.5f}}};
  const auto budget = static_cast<double>(triangles);
  // A ball of n segments and n / 2 rings has n (n - 2) triangles, n even.
  const double perBall = (1.0 - shareOfFloor) * budget / balls;
  const int segments = std::max(6, 2 * static_cast<int>(std::lround(0.5 * (1.0 + std::sqrt(1.0 + perBall)))));
  const double inFloor = budget - 1.0 * balls * segments * (segments - 2);
  const int cells = std::max(1, static_cast<int>(std::lround(std::sqrt(std::max(0.0, inFloor) / 2.0))));
  constexpr double half = 0.5 * (rows + 1) * spacing;

  GltfBuilder builder(fmt::format("balls of {} triangles", triangles));
  builder.addObject("Floor", makeGrid({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, cells, cells),
                    builder.addDiffuse("Floor", {0.7f, 0.7f, 0.7f}));
  std::array<int, albedos.size()> materials{};
  for (std::size_t m = 0; m < albedos.size(); ++m)
    materials[m] = builder.addDiffuse(fmt::format("Ball {}", m), albedos[m]);
  for (int i = 0; i < balls; ++i)
    builder.addObject(fmt::format("Ball {}", i), makeBall(segments, i),
                      materials[static_cast<std::size_t>(i) % materials.size()],
                      {static_cast<float>((i % rows - 0.5 * (rows - 1)) * spacing), lift,
                       static_cast<float>((static_cast<double>(i / rows) - 0.5 * (rows - 1)) * spacing)});
  builder.addPointLight("Light", {2.0f, 6.0f, 3.0f}, {1.0f, 1.0f, 1.0f}, 100.0);
  builder.addCamera("Camera", {0.0, 5.0, 9.0}, {0.0, 0.3, 0.0}, 0.7, 4.0 / 3.0);
  return builder.take();
}

}  // namespace prelight::benchmarks
