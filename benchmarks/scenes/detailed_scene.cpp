#include "benchmarks/scenes/detailed_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "receivers/sampling.h"
#include "scene/builtin/gltf_builder.h"
#include "scene/builtin/mesh_shapes.h"

namespace prelight::benchmarks {

namespace {

/// Returns a number in [0,1). It is the same on every machine, unlike those of the standard library's
/// distributions.
inline double unitOf(std::uint32_t hash) { return hash * 0x1p-32; }

/// Returns smooth value noise of three components in [-1, 1], on a lattice of unit spacing.
glm::dvec3 noise(const glm::dvec3& p) {
  const glm::ivec3 cell(glm::floor(p));
  const glm::dvec3 f = p - glm::floor(p);
  const glm::dvec3 s = f * f * (3.0 - 2.0 * f);
  glm::dvec3 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 w = glm::mix(1.0 - s, s, glm::dvec3(at));
    const glm::uvec3 q(cell + at);
    const std::uint32_t hash = sampling::hashInteger(q.x ^ sampling::hashInteger(q.y + 0x9e3779b9u) ^
                                                     sampling::hashInteger(q.z + 0x3c6ef372u));
    const glm::dvec3 value(unitOf(hash), unitOf(sampling::hashInteger(hash + 1)),
                           unitOf(sampling::hashInteger(hash + 2)));
    sum += w.x * w.y * w.z * (2.0 * value - 1.0);
  }
  return sum;
}

/// Moves vertices by smooth noise that depends only on their position and `seed`, so that surfaces that meet
/// still do. The result is the same on every machine. Normals stay as they were.
void displace(MeshShape& shape, double amplitude, double frequency, double seed) {
  for (glm::vec3& position : shape.positions) {
    const glm::dvec3 p = frequency * glm::dvec3(position) + 37.0 * seed;
    position += glm::vec3(amplitude * (noise(p) + 0.5 * noise(2.3 * p) + 0.25 * noise(5.1 * p)));
  }
}

constexpr double half = 6.0;  // of the floor's sides, metres
constexpr double ceilingHeight = 3.0;
constexpr double thickness = 0.2;         // of the walls between rooms
constexpr double surfaceOfWalls = 540.0;  // square metres, floor and ceiling among them
constexpr double shareOfWalls = 0.3;      // of the triangles
constexpr int meshCount = 15;

/// Returns a mesh without normals: compiling the scene fills in those of the displaced faces.
Mesh meshOf(MeshShape&& shape, const std::string& name) {
  Primitive primitive;
  primitive.normals.resize(shape.positions.size(), glm::vec3(0.0f));
  primitive.positions = std::move(shape.positions);
  primitive.triangles = std::move(shape.triangles);
  primitive.material = 0;
  return {name, {std::move(primitive)}};
}

/// Floor, ceiling and walls of the rooms, divided into cells of one size.
class Shell {
 public:
  explicit Shell(double cell) : cell_(cell) {}

  MeshShape make() {
    const double side = 2.0 * half;
    surface({-half, 0, half}, {side, 0, 0}, {0, 0, -side});
    surface({-half, ceilingHeight, -half}, {side, 0, 0}, {0, 0, side});
    wall({half, 0, half}, {-side, 0, 0});
    wall({-half, 0, -half}, {side, 0, 0});
    wall({-half, 0, half}, {0, 0, -side});
    wall({half, 0, -half}, {0, 0, side});
    for (const double sign : {-1.0, 1.0}) {  // doors of 1.2 m lie between the walls and the middle
      partition({sign * 4.8, 0, 0}, {1.2, 0, 0});
      partition({sign * 1.2, 0, 0}, {1.2, 0, 0});
      partition({0, 0, sign * 4.8}, {0, 0, 1.2});
      partition({0, 0, sign * 1.2}, {0, 0, 1.2});
    }
    return std::move(shell_);
  }

 private:
  void surface(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    const auto cells = [&](const glm::dvec3& edge) {
      return std::max(1, static_cast<int>(std::lround(glm::length(edge) / cell_)));
    };
    shell_.add(makeGrid(corner, u, v, cells(u), cells(v)));
  }

  void wall(const glm::dvec3& corner, const glm::dvec3& along) {
    surface(corner, along, {0, ceilingHeight, 0});
  }

  void partition(const glm::dvec3& centre, const glm::dvec3& reach) {
    const glm::dvec3 across = 0.5 * thickness * glm::normalize(glm::cross(reach, glm::dvec3(0, 1, 0)));
    wall(centre - reach + across, 2.0 * reach);
    wall(centre + reach - across, -2.0 * reach);
    wall(centre - reach - across, 2.0 * across);
    wall(centre + reach + across, -2.0 * across);
  }

  double cell_;
  MeshShape shell_;
};

/// Returns an object about a metre wide with about `triangles` triangles.
MeshShape makeObject(int kind, double triangles) {
  const auto cut = [](double n) { return std::max(3, static_cast<int>(std::lround(n))); };
  switch (kind % 5) {
    case 0:
      return makeSphere(0.5f, cut(std::sqrt(triangles)), cut(std::sqrt(triangles) / 2));
    case 1:
      return makeTorus(0.35f, 0.15f, cut(std::sqrt(triangles)), cut(std::sqrt(triangles) / 2));
    case 2:
      return makeCone(0.5f, 1.0f, cut(std::sqrt(triangles)), cut(std::sqrt(triangles) / 3),
                      cut(std::sqrt(triangles) / 6));
    case 3:
      return makeCylinder(0.35f, 1.0f, cut(std::sqrt(triangles)), cut(std::sqrt(triangles) / 4),
                          cut(std::sqrt(triangles) / 8));
    default:
      return makeBox({0.8, 0.9, 0.7}, cut(std::sqrt(triangles / 12)), true);
  }
}

/// Returns the place of an object: scattered over the floor, standing or hung up, turned and scaled.
glm::dmat4 placeObject(int index, int columns) {
  std::uint32_t state = sampling::hashInteger(static_cast<std::uint32_t>(index) + 1);
  const auto next = [&] { return unitOf(state = sampling::hashInteger(state + 0x9e3779b9u)); };
  const double spacing = 2.0 * (half - 0.3) / columns;
  const double scale = std::min(1.0, spacing) * (0.6 + 0.7 * next());
  const double x = (index % columns + 0.2 + 0.6 * next()) * spacing - half + 0.3;
  const double z = (static_cast<double>(index / columns) + 0.2 + 0.6 * next()) * spacing - half + 0.3;
  const double y = next() < 0.6 ? 0.0 : next() * (ceilingHeight - 1.3);
  glm::dmat4 place = glm::translate(glm::dmat4(1.0), {x, y, z});
  place = glm::rotate(place, 6.2832 * next(), {0, 1, 0});
  place = glm::rotate(place, 0.6 * (next() - 0.5), {1, 0, 0});
  return glm::scale(place, glm::dvec3(scale));
}

void addLightsAndCamera(Scene& scene) {
  for (const double x : {-3.0, 3.0})
    for (const double z : {-3.0, 3.0}) {
      Light light;
      light.position = {x, ceilingHeight - 0.2, z};
      scene.lights.push_back(light);
    }
  Camera camera;
  camera.world = glm::inverse(
      glm::lookAt(glm::dvec3(-5.4, 2.2, -5.4), glm::dvec3(-1.0, 0.9, -2.0), glm::dvec3(0, 1, 0)));
  camera.yFov = 1.1;
  scene.cameras.push_back(camera);
}

}  // namespace

BenchmarkScene makeDetailedRooms(std::uint64_t triangles) {
  const auto budget = static_cast<double>(triangles);
  const int objects = std::max(4, static_cast<int>(std::lround(0.5 * std::pow(budget, 0.4))));
  const int columns = static_cast<int>(std::ceil(std::sqrt(objects)));
  BenchmarkScene result;
  result.name = sizeName(triangles);
  Scene& scene = result.scene;
  Material plaster;
  plaster.baseColor = {0.7f, 0.7f, 0.7f, 1.0f};
  plaster.metallic = 0.0f;
  scene.materials.push_back(plaster);

  MeshShape shell = Shell(std::sqrt(2.0 * surfaceOfWalls / (shareOfWalls * budget))).make();
  displace(shell, 0.02, 1.7, 0.0);
  const double perObject = (budget - static_cast<double>(shell.triangles.size())) / objects;
  scene.meshes.push_back(meshOf(std::move(shell), "Rooms"));
  scene.meshNodes.push_back({0, "Rooms", 0, {glm::dmat4(1.0)}});
  for (int m = 0; m < meshCount; ++m) {
    MeshShape object = makeObject(m, perObject);
    displace(object, 0.05, 6.0, 1.0 + m);
    scene.meshes.push_back(meshOf(std::move(object), fmt::format("Object {}", m)));
    scene.meshNodes.push_back({m + 1, "", m + 1, {}});
  }
  for (int i = 0; i < objects; ++i)
    scene.meshNodes[static_cast<std::size_t>(1 + i % meshCount)].transforms.push_back(
        placeObject(i, columns));
  addLightsAndCamera(scene);
  Warnings warnings;
  result.compiled = compileScene(scene, warnings);
  scene.meshes.clear();
  scene.meshNodes.clear();
  return result;
}

std::string sizeName(std::uint64_t triangles) {
  if (triangles >= 1000000) return fmt::format("{:.3g}M", static_cast<double>(triangles) * 1e-6);
  return fmt::format("{:.3g}k", static_cast<double>(triangles) * 1e-3);
}

namespace {

constexpr int rows = 5;
constexpr double spacing = 1.4;  // metres
constexpr float radius = 0.55f;
constexpr double bump = 0.03;         // twice as much would fold the surface
constexpr double shareOfFloor = 0.1;  // of the triangles
constexpr float lift = 0.01f;         // of balls, so that none reaches below the floor

/// Sets normals to area-weighted means of the triangles' normals.
void smoothNormals(MeshShape& shape) {
  std::vector<glm::dvec3> sums(shape.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : shape.triangles) {
    const glm::dvec3 p(shape.positions[t.x]), q(shape.positions[t.y]), r(shape.positions[t.z]);
    const glm::dvec3 normal = glm::cross(q - p, r - p);
    sums[t.x] += normal, sums[t.y] += normal, sums[t.z] += normal;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) shape.normals[v] = glm::vec3(glm::normalize(sums[v]));
}

/// Returns a bumpy ball that stands on y = 0 around the y axis.
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
