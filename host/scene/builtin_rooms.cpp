#include <cmath>

#include "scene/builtin_scenes.h"
#include "scene/gltf_builder.h"

namespace prelight {

namespace {

// All lengths in metres and multiples of the cell, so that surfaces share their edges' vertices exactly.
constexpr float cell = 0.2f;
constexpr float height = 2.6f;
constexpr float length = 4.0f;
constexpr float depth = 4.0f;
constexpr float halfWall = 0.1f;
constexpr float doorHeight = 2.0f;
constexpr float halfDoor = 0.4f;

MeshShape makeSurface(const glm::vec3& corner, const glm::vec3& edgeU, const glm::vec3& edgeV) {
  const auto cells = [](const glm::vec3& edge) {
    return static_cast<int>(std::lround(glm::length(edge) / cell));
  };
  return makeGrid(corner, edgeU, edgeV, cells(edgeU), cells(edgeV));
}

/// The three outer walls and the one with the door of the room on one `side` (-1 left, +1 right) of x = 0.
MeshShape makeWalls(float side) {
  const float nearX = side * halfWall;
  const float farX = side * (halfWall + length);
  const float half = depth / 2.0f;
  const glm::vec3 up(0.0f, height, 0.0f);
  // Seen from inside, a wall runs to the right: along -side z on the far wall, and so on around the room.
  MeshShape walls = makeSurface({farX, 0.0f, -side * half}, {0.0f, 0.0f, side * depth}, up);
  walls.add(makeSurface({-side > 0 ? farX : nearX, 0.0f, -half}, {length, 0.0f, 0.0f}, up));
  walls.add(makeSurface({-side > 0 ? nearX : farX, 0.0f, half}, {-length, 0.0f, 0.0f}, up));
  const glm::vec3 beside(0.0f, 0.0f, -side * (half - halfDoor));
  const glm::vec3 across(0.0f, 0.0f, -side * 2.0f * halfDoor);
  walls.add(makeSurface({nearX, 0.0f, side * half}, beside, {0.0f, doorHeight, 0.0f}));
  walls.add(makeSurface({nearX, 0.0f, -side * halfDoor}, beside, {0.0f, doorHeight, 0.0f}));
  const glm::vec3 lintel(0.0f, height - doorHeight, 0.0f);
  walls.add(makeSurface({nearX, doorHeight, side * half}, beside, lintel));
  walls.add(makeSurface({nearX, doorHeight, side * halfDoor}, across, lintel));
  walls.add(makeSurface({nearX, doorHeight, -side * halfDoor}, beside, lintel));
  return walls;
}

MeshShape makeHorizontal(float lowX, float lengthX, float halfZ, float y, bool facesUp) {
  const glm::vec3 x(lengthX, 0.0f, 0.0f);
  const glm::vec3 z(0.0f, 0.0f, 2.0f * halfZ);
  const glm::vec3 corner(lowX, y, -halfZ);
  return facesUp ? makeSurface(corner + z, x, -z) : makeSurface(corner, x, z);
}

/// The opening through the wall: threshold, underside of the lintel, jambs.
MeshShape makeDoorway() {
  const glm::vec3 through(2.0f * halfWall, 0.0f, 0.0f);
  const glm::vec3 up(0.0f, doorHeight, 0.0f);
  MeshShape doorway = makeHorizontal(-halfWall, 2.0f * halfWall, halfDoor, 0.0f, true);
  doorway.add(makeHorizontal(-halfWall, 2.0f * halfWall, halfDoor, doorHeight, false));
  doorway.add(makeSurface({-halfWall, 0.0f, -halfDoor}, through, up));
  doorway.add(makeSurface({halfWall, 0.0f, halfDoor}, -through, up));
  return doorway;
}

}  // namespace

GltfDocument makeRoomsScene() {
  GltfBuilder builder("rooms");
  const int floor = builder.addDiffuse("Floor", {0.45f, 0.32f, 0.2f});
  const int white = builder.addDiffuse("White", {0.78f, 0.78f, 0.76f});
  const int leftPaint = builder.addDiffuse("Left paint", {0.75f, 0.6f, 0.4f});
  const int rightPaint = builder.addDiffuse("Right paint", {0.45f, 0.6f, 0.75f});
  const int wood = builder.addDiffuse("Wood", {0.5f, 0.25f, 0.12f});
  const float half = depth / 2.0f;
  const float leftX = -halfWall - length;
  builder.addObject("Left floor", makeHorizontal(leftX, length, half, 0.0f, true), floor);
  builder.addObject("Left ceiling", makeHorizontal(leftX, length, half, height, false), white);
  builder.addObject("Left walls", makeWalls(-1.0f), leftPaint);
  builder.addObject("Right floor", makeHorizontal(halfWall, length, half, 0.0f, true), floor);
  builder.addObject("Right ceiling", makeHorizontal(halfWall, length, half, height, false), white);
  builder.addObject("Right walls", makeWalls(1.0f), rightPaint);
  builder.addObject("Doorway", makeDoorway(), white);
  builder.addObject("Left crate", makeBox({0.8f, 0.8f, 0.8f}, 8, false), wood, {-3.2f, 0.0f, -1.1f}, 0.2);
  builder.addObject("Right crate", makeBox({0.8f, 1.0f, 0.8f}, 8, false), wood, {2.0f, 0.0f, -1.2f}, -0.3);
  builder.addPointLight("Light", {-1.9f, 2.2f, 0.4f}, {1.0f, 0.93f, 0.82f}, 10.0);
  builder.addCamera("Camera", {3.7, 1.6, 1.5}, {0.4, 1.1, -0.4}, 1.0, 16.0 / 9.0);
  return builder.take();
}

}  // namespace prelight
