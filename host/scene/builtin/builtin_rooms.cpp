#include <cmath>
#include <string>

#include "scene/builtin/builtin_scenes.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight {

namespace {

// All lengths in metres and multiples of the cell, so that surfaces share their edges' vertices exactly.
constexpr double cell = 0.2;
constexpr double height = 2.6;
constexpr double length = 4.0;
constexpr double depth = 4.0;
constexpr double halfWall = 0.1;
constexpr double doorHeight = 2.0;
constexpr double halfDoor = 0.4;

MeshShape makeSurface(const glm::dvec3& corner, const glm::dvec3& edgeU, const glm::dvec3& edgeV) {
  const auto cells = [](const glm::dvec3& edge) {
    return static_cast<int>(std::lround(glm::length(edge) / cell));
  };
  return makeGrid(corner, edgeU, edgeV, cells(edgeU), cells(edgeV));
}

/// Returns the three outer walls and the wall with the door of the room on one `side` (-1 left, +1 right) of
/// x = 0.
MeshShape makeWalls(double side) {
  const double nearX = side * halfWall;
  const double farX = side * (halfWall + length);
  const double half = depth / 2.0;
  const glm::dvec3 up(0.0, height, 0.0);
  // Seen from inside, a wall runs to the right: along -side z on the far wall, and so on around the room.
  MeshShape walls = makeSurface({farX, 0.0, -side * half}, {0.0, 0.0, side * depth}, up);
  walls.add(makeSurface({-side > 0 ? farX : nearX, 0.0, -half}, {length, 0.0, 0.0}, up));
  walls.add(makeSurface({-side > 0 ? nearX : farX, 0.0, half}, {-length, 0.0, 0.0}, up));
  const glm::dvec3 beside(0.0, 0.0, -side * (half - halfDoor));
  const glm::dvec3 across(0.0, 0.0, -side * 2.0 * halfDoor);
  walls.add(makeSurface({nearX, 0.0, side * half}, beside, {0.0, doorHeight, 0.0}));
  walls.add(makeSurface({nearX, 0.0, -side * halfDoor}, beside, {0.0, doorHeight, 0.0}));
  const glm::dvec3 lintel(0.0, height - doorHeight, 0.0);
  walls.add(makeSurface({nearX, doorHeight, side * half}, beside, lintel));
  walls.add(makeSurface({nearX, doorHeight, side * halfDoor}, across, lintel));
  walls.add(makeSurface({nearX, doorHeight, -side * halfDoor}, beside, lintel));
  return walls;
}

MeshShape makeHorizontal(double lowX, double lengthX, double halfZ, double y, bool facesUp) {
  const glm::dvec3 x(lengthX, 0.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 2.0 * halfZ);
  const glm::dvec3 corner(lowX, y, -halfZ);
  return facesUp ? makeSurface(corner + z, x, -z) : makeSurface(corner, x, z);
}

/// Returns the surface that closes a room's door opening, in the plane of its wall.
MeshShape makeDoor(double side) {
  return makeSurface({side * halfWall, 0.0, side * halfDoor}, {0.0, 0.0, -side * 2.0 * halfDoor},
                     {0.0, doorHeight, 0.0});
}

/// Returns the inside of the door opening through the wall: threshold, underside of the lintel, jambs.
MeshShape makeDoorway() {
  const glm::dvec3 through(2.0 * halfWall, 0.0, 0.0);
  const glm::dvec3 up(0.0, doorHeight, 0.0);
  MeshShape doorway = makeHorizontal(-halfWall, 2.0 * halfWall, halfDoor, 0.0, true);
  doorway.add(makeHorizontal(-halfWall, 2.0 * halfWall, halfDoor, doorHeight, false));
  doorway.add(makeSurface({-halfWall, 0.0, -halfDoor}, through, up));
  doorway.add(makeSurface({halfWall, 0.0, halfDoor}, -through, up));
  return doorway;
}

GltfDocument makeRooms(const std::string& name, bool sealed) {
  GltfBuilder builder(name);
  const int floor = builder.addDiffuse("Floor", {0.45, 0.32, 0.2});
  const int white = builder.addDiffuse("White", {0.78, 0.78, 0.76});
  const int leftPaint = builder.addDiffuse("Left paint", {0.75, 0.6, 0.4});
  const int rightPaint = builder.addDiffuse("Right paint", {0.45, 0.6, 0.75});
  const int wood = builder.addDiffuse("Wood", {0.5, 0.25, 0.12});
  const double half = depth / 2.0;
  const double leftX = -halfWall - length;
  builder.addObject("Left floor", makeHorizontal(leftX, length, half, 0.0, true), floor);
  builder.addObject("Left ceiling", makeHorizontal(leftX, length, half, height, false), white);
  builder.addObject("Left walls", makeWalls(-1.0), leftPaint);
  builder.addObject("Right floor", makeHorizontal(halfWall, length, half, 0.0, true), floor);
  builder.addObject("Right ceiling", makeHorizontal(halfWall, length, half, height, false), white);
  builder.addObject("Right walls", makeWalls(1.0), rightPaint);
  if (sealed) {
    builder.addObject("Left door", makeDoor(-1.0), wood);
    builder.addObject("Right door", makeDoor(1.0), wood);
  } else {
    builder.addObject("Doorway", makeDoorway(), white);
  }
  builder.addObject("Left crate", makeBox({0.8, 0.8, 0.8}, 8, false), wood, {-3.2, 0.0, -1.1}, 0.2);
  builder.addObject("Right crate", makeBox({0.8, 1.0, 0.8}, 8, false), wood, {2.0, 0.0, -1.2}, -0.3);
  builder.addPointLight("Light", {-1.9, 2.2, 0.4}, {1.0, 0.93, 0.82}, 10.0);
  builder.addCamera("Camera", {3.7, 1.6, 1.5}, {0.4, 1.1, -0.4}, 1.0, 16.0 / 9.0);
  return builder.take();
}

}  // namespace

GltfDocument makeRoomsScene() { return makeRooms("rooms", false); }

GltfDocument makeSealedRoomsScene() { return makeRooms("rooms-sealed", true); }

}  // namespace prelight
