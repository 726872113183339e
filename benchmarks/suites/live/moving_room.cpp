#include "benchmarks/suites/live/moving_room.h"

#include <cmath>
#include <numbers>

#include "scene/builtin/gltf_builder.h"
#include "scene/gltf/loader.h"

namespace prelight::benchmarks {

namespace {

constexpr double bumpHeight = 0.012;  // m
constexpr double bumps = 5.0;         // along a side

/// A rectangle with bumps that fade towards its edges, so that walls still meet.
MeshShape makeWall(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV, int cells) {
  MeshShape wall = makeGrid(corner, edgeU, edgeV, cells, cells);
  if (cells == 1) return wall;
  const glm::dvec3 normal = glm::normalize(glm::cross(edgeU, edgeV));
  const double k = std::numbers::pi * bumps;
  for (std::size_t i = 0; i < wall.positions.size(); ++i) {
    const glm::dvec3 from = glm::dvec3(wall.positions[i]) - corner;
    const double u = glm::dot(from, edgeU) / glm::dot(edgeU, edgeU);
    const double v = glm::dot(from, edgeV) / glm::dot(edgeV, edgeV);
    const double slopeU = bumpHeight * k * std::cos(k * u) * std::sin(k * v);
    const double slopeV = bumpHeight * k * std::sin(k * u) * std::cos(k * v);
    wall.positions[i] += glm::vec3(normal * (bumpHeight * std::sin(k * u) * std::sin(k * v)));
    wall.normals[i] = glm::vec3(glm::normalize(normal - edgeU * (slopeU / glm::dot(edgeU, edgeU)) -
                                               edgeV * (slopeV / glm::dot(edgeV, edgeV))));
  }
  return wall;
}

void addRoom(GltfBuilder& builder, int cells) {
  const int white = builder.addDiffuse("White", {0.73f, 0.73f, 0.73f});
  const int red = builder.addDiffuse("Red", {0.63f, 0.065f, 0.05f});
  const int green = builder.addDiffuse("Green", {0.14f, 0.45f, 0.091f});
  const glm::dvec3 x(2.0, 0.0, 0.0), y(0.0, 2.0, 0.0), z(0.0, 0.0, 2.0), low(-1.0, 0.0, -1.0);
  builder.addObject("Floor", makeWall(low + z, x, -z, cells), white);
  builder.addObject("Ceiling", makeWall(low + y, x, z, cells), white);
  builder.addObject("Back wall", makeWall(low, x, y, cells), white);
  builder.addObject("Left wall", makeWall(low + z, -z, y, cells), red);
  builder.addObject("Right wall", makeWall(low + x, z, y, cells), green);
  builder.addObject("Lamp", makeGrid({-0.24, 1.97, -0.19}, {0.48, 0.0, 0.0}, {0.0, 0.0, 0.38}, 1, 1),
                    builder.addEmitter("Lamp", {17.0f, 12.0f, 4.0f}));
  builder.addCamera("Camera", {0.0, 1.0, 4.0}, {0.0, 1.0, 0.0}, 0.66, 1.0);
}

}  // namespace

BenchmarkScene makeMovingRoom(int cells) {
  GltfBuilder builder("moving room");
  addRoom(builder, cells);
  const int box = builder.addDiffuse("Cube", {0.73f, 0.73f, 0.73f});
  const bool detailed = cells > 1;
  builder.addObject("Cube", makeBox({0.5, 0.5, 0.5}, detailed ? 4 : 1, true), box, {-0.35f, 0.25f, -0.2f},
                    0.3);
  if (detailed)
    builder.addObject("Ball", makeSphere(0.25f, 32, 20), builder.addGlass("Glass", 1.5f), {0.4f, 0.1f, 0.2f});
  else
    builder.addObject("Other cube", makeBox({0.5, 0.5, 0.5}, 1, false), box, {0.4f, 0.0f, 0.2f}, -0.3);
  Warnings warnings;
  BenchmarkScene made;
  made.name = "moving room";
  const GltfDocument document = builder.take();
  made.scene = loadScene(document, warnings);
  made.compiled = compileScene(made.scene, warnings);
  return made;
}

}  // namespace prelight::benchmarks
