#include "scene/builtin/builtin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "base/text.h"
#include "prelight/error.h"
#include "scene/builtin/crowd_scene.h"
#include "scene/builtin/gltf_builder.h"
#include "scene/builtin/salon_scene.h"
#include "scene/builtin/water_scenes.h"

namespace prelight {

namespace {

/// Adds the material of a part, by its name and colour.
using Finish = std::function<int(GltfBuilder& builder, const std::string& name, const glm::vec3& albedo)>;

/// Five objects of 9.8 k triangles with their ground under a point light, after Figure 7.22 of Sherif's
/// thesis.
GltfDocument makeShapes(const std::string& name, const Finish& finish) {
  GltfBuilder builder(name);
  const auto paint = [&](const std::string& color, const glm::vec3& albedo) {
    return finish(builder, color, albedo);
  };
  // Objects hover by a centimetre: no face lies in the ground's plane.
  constexpr float lift = 0.01f;
  builder.addObject("Ground", makeGrid({-4.0, 0.0, 4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -8.0}, 32, 32),
                    paint("Ground", {0.7f, 0.7f, 0.7f}));
  builder.addObject("Sphere", makeSphere(0.8f, 36, 26), paint("Red", {0.75f, 0.15f, 0.12f}),
                    {-1.9f, lift, 0.9f});
  builder.addObject("Torus", makeTorus(0.7f, 0.3f, 48, 24), paint("Yellow", {0.8f, 0.65f, 0.12f}),
                    {0.1f, lift, 1.6f});
  builder.addObject("Box", makeBox({1.2, 1.2, 1.2}, 8, true), paint("Blue", {0.15f, 0.25f, 0.75f}),
                    {1.9f, lift, 0.6f}, 0.4);
  builder.addObject("Cone", makeCone(0.7f, 1.7f, 40, 12, 4), paint("Green", {0.2f, 0.65f, 0.2f}),
                    {-0.9f, lift, -1.3f});
  builder.addObject("Cylinder", makeCylinder(0.5f, 1.5f, 40, 14, 4), paint("Violet", {0.55f, 0.25f, 0.65f}),
                    {1.1f, lift, -1.5f});
  builder.addPointLight("Light", {1.5f, 5.0f, 2.5f}, {1.0f, 1.0f, 1.0f}, 80.0);
  builder.addCamera("Camera", {0.0, 4.2, 7.6}, {0.0, 0.5, 0.0}, 0.6, 4.0 / 3.0);
  return builder.take();
}

GltfDocument makeShapesScene() {
  return makeShapes("shapes", [](GltfBuilder& builder, const std::string& name, const glm::vec3& albedo) {
    return builder.addDiffuse(name, albedo);
  });
}

/// Returns `shapes` with a polished ground, a ball and a ring of metal and plastic otherwise, so that objects
/// mirror one another.
GltfDocument makeShinyScene() {
  return makeShapes("shiny", [](GltfBuilder& builder, const std::string& name, const glm::vec3& albedo) {
    PlainMaterial material{.name = name, .baseColor = glm::vec4(albedo, 1.0f), .roughness = 0.3f};
    const bool metal = name == "Red" || name == "Yellow";
    if (metal) material.metallic = 1.0f;
    if (!metal) material.specular = 1.0f;
    if (name == "Ground") material.ior = 1.8f;  // reflects 8 % along the normal
    return builder.addPlain(material);
  });
}

constexpr int wallCells = 32;

/// Adds floor, ceiling, back and coloured side walls of x, z in [-1, 1] and y in [0, 2], lamp and camera.
void addRoom(GltfBuilder& builder) {
  const int white = builder.addDiffuse("White", {0.73f, 0.73f, 0.73f});
  const int red = builder.addDiffuse("Red", {0.63f, 0.065f, 0.05f});
  const int green = builder.addDiffuse("Green", {0.14f, 0.45f, 0.091f});
  const glm::dvec3 x(2.0, 0.0, 0.0);
  const glm::dvec3 y(0.0, 2.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 2.0);
  const glm::dvec3 low(-1.0, 0.0, -1.0);
  builder.addObject("Floor", makeGrid(low + z, x, -z, wallCells, wallCells), white);
  builder.addObject("Ceiling", makeGrid(low + y, x, z, wallCells, wallCells), white);
  builder.addObject("Back wall", makeGrid(low, x, y, wallCells, wallCells), white);
  builder.addObject("Left wall", makeGrid(low + z, -z, y, wallCells, wallCells), red);
  builder.addObject("Right wall", makeGrid(low + x, z, y, wallCells, wallCells), green);
  builder.addObject("Lamp", makeGrid({-0.24, 1.99, -0.19}, {0.48, 0.0, 0.0}, {0.0, 0.0, 0.38}, 1, 1),
                    builder.addEmitter("Lamp", {17.0f, 12.0f, 4.0f}));
  builder.addCamera("Camera", {0.0, 1.0, 4.0}, {0.0, 1.0, 0.0}, 0.66, 1.0);
}

/// A Cornell box of 2 m: coloured walls, open to +Z, two boxes, an emissive quad that shines down.
GltfDocument makeCornellScene() {
  GltfBuilder builder("cornell");
  addRoom(builder);
  const int white = builder.addDiffuse("Box", {0.73f, 0.73f, 0.73f});
  builder.addObject("Tall box", makeBox({0.6, 1.2, 0.6}, 12, false), white, {-0.34f, 0.0f, -0.3f}, 0.3);
  builder.addObject("Short box", makeBox({0.6, 0.6, 0.6}, 12, false), white, {0.34f, 0.0f, 0.35f}, -0.3);
  return builder.take();
}

/// The Cornell box with a solid glass sphere and a mirror box.
GltfDocument makeCausticsScene() {
  GltfBuilder builder("caustics");
  addRoom(builder);
  // The sphere hovers by a centimetre: glass that touches the floor would share a point with it.
  builder.addObject("Glass sphere", makeSphere(0.38f, 48, 32), builder.addGlass("Glass", 1.5f),
                    {0.42f, 0.01f, 0.35f});
  builder.addObject("Mirror box", makeBox({0.6, 1.2, 0.6}, 4, false),
                    builder.addMirror("Mirror", {0.95f, 0.95f, 0.95f}), {-0.34f, 0.0f, -0.3f}, 0.3);
  return builder.take();
}

constexpr int mapSize = 256;

/// A height field over the unit square, which repeats, in units of the square's side.
using Height = std::function<double(double u, double v)>;

/// Returns the normal map of a height field, by central differences; v runs down, green is up.
Image normalsOf(const std::string& name, const Height& height) {
  Image image{name, mapSize, mapSize, {}};
  constexpr double step = 0.5 / mapSize;
  for (int row = 0; row < mapSize; ++row)
    for (int column = 0; column < mapSize; ++column) {
      const double u = (column + 0.5) / mapSize, v = (row + 0.5) / mapSize;
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3(-(height(u + step, v) - height(u - step, v)),
                                    height(u, v + step) - height(u, v - step), 2.0 * step));
      for (int a = 0; a < 3; ++a)
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (normal[a] + 1.0))));
      image.rgba.push_back(255);
    }
  return image;
}

/// Round cobbles in rows that are shifted by half.
double cobbles(double u, double v) {
  constexpr double rows = 4.0, columns = 4.0;
  const double row = std::floor(v * rows);
  const double y = v * rows - row - 0.5;
  const double along = u * columns + 0.5 * std::fmod(row + rows, 2.0);
  const double x = along - std::floor(along) - 0.5;
  const double r2 = 4.6 * (x * x + y * y);
  return 0.09 * std::sqrt(std::max(0.0, 1.0 - r2));
}

/// Soft waves in both directions.
double waves(double u, double v) {
  constexpr double turn = 2.0 * std::numbers::pi;
  return 0.012 * (std::sin(turn * (3.0 * u + v)) + std::sin(turn * (5.0 * v - 2.0 * u)));
}

/// A ground of cobbles and a rough wall, by normal maps, and a block that reaches into the ground; all
/// unfolded for light maps.
GltfDocument makeBumpsScene() {
  GltfBuilder builder("bumps");
  const Image stones = normalsOf("Cobbles", cobbles), plaster = normalsOf("Plaster", waves);
  builder.addUnfolded("Ground", makeGrid({-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0}, 24, 24),
                      builder.addBumpy("Stone", {0.55f, 0.52f, 0.48f}, stones, 3.0f));
  builder.addUnfolded("Wall", makeGrid({-2.0, 0.0, -2.0}, {4.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, 24, 12),
                      builder.addBumpy("Plaster", {0.75f, 0.6f, 0.45f}, plaster, 2.0f));
  // The block reaches below the ground, as objects in scenes often do.
  builder.addUnfolded("Block", makeBox({1.1, 1.0, 0.8}, 8, true),
                      builder.addDiffuse("Blue", {0.2f, 0.3f, 0.7f}), {-0.5f, -0.1f, -0.5f}, 0.5);
  builder.addPointLight("Light", {2.5f, 3.0f, 2.0f}, {1.0f, 0.95f, 0.85f}, 30.0);
  builder.addCamera("Camera", {1.6, 2.2, 4.0}, {-0.1, 0.3, -0.4}, 0.75, 4.0 / 3.0);
  return builder.take();
}

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

/// Two closed rooms joined by a door opening; a point light in the left, the camera in the right.
GltfDocument makeRoomsScene() { return makeRooms("rooms", false); }

GltfDocument makeSealedRoomsScene() { return makeRooms("rooms-sealed", true); }

constexpr const char* animationName = "swing";

glm::vec4 turn(const glm::vec3& axis, double degrees) {
  const double half = degrees * std::numbers::pi / 360.0;
  return {axis * static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

/// Returns a full turn in steps of a quarter, so that each step has an unambiguous shorter arc.
AnimationSampler fullTurn() {
  AnimationSampler sampler{Interpolation::Linear, {0, 1, 2, 3, 4}, {}};
  for (int quarter = 0; quarter <= 4; ++quarter)
    sampler.values.push_back(turn({0.0f, 1.0f, 0.0f}, 90.0 * quarter));
  return sampler;
}

/// Returns a swing: out, back through the middle, out on the other side and back. Tangents are those of a
/// sine in the angle.
AnimationSampler pendulum(double degrees) {
  AnimationSampler sampler{Interpolation::CubicSpline, {0, 1, 2, 3, 4}, {}};
  const double amplitude = degrees * std::numbers::pi / 180.0;
  for (int key = 0; key <= 4; ++key) {
    const double phase = key * std::numbers::pi / 2.0;
    const double half = 0.5 * amplitude * std::sin(phase);
    const double slope = 0.25 * std::numbers::pi * amplitude * std::cos(phase);
    const glm::vec4 tangent(0.0f, 0.0f, std::cos(half) * slope, -std::sin(half) * slope);
    sampler.values.insert(
        sampler.values.end(),
        {tangent, turn({0.0f, 0.0f, 1.0f}, 2.0 * half * 180.0 / std::numbers::pi), tangent});
  }
  return sampler;
}

/// Returns a board that hangs from the node's origin.
MeshShape makeBoard() {
  constexpr float boardLength = 1.5f;
  MeshShape board = makeBox({0.12, boardLength, 0.9}, 10, true);
  for (glm::vec3& position : board.positions) position.y -= boardLength;
  return board;
}

/// A ground under an emissive lamp with a box that turns, a ball that crosses and a board that swings: one
/// animation of 4 s.
GltfDocument makeSwingScene() {
  GltfBuilder builder("swing");
  constexpr float lift = 0.01f;
  builder.addObject("Ground", makeGrid({-3.0, 0.0, 3.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, -6.0}, 36, 36),
                    builder.addDiffuse("Ground", {0.7f, 0.7f, 0.7f}));
  const int box = builder.addObject("Box", makeBox({1.2, 0.8, 0.6}, 8, true),
                                    builder.addDiffuse("Blue", {0.15f, 0.25f, 0.75f}), {1.5f, lift, 0.9f});
  const int ball = builder.addObject("Ball", makeSphere(0.45f, 24, 18),
                                     builder.addDiffuse("Red", {0.75f, 0.15f, 0.12f}), {-2.3f, lift, 1.2f});
  const int board = builder.addObject(
      "Board", makeBoard(), builder.addDiffuse("Yellow", {0.8f, 0.65f, 0.12f}), {-0.4f, 1.8f, -1.1f});
  builder.addObject("Lamp", makeGrid({-0.5, 3.5, -0.5}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1, 1),
                    builder.addEmitter("Lamp", {30.0f, 28.0f, 24.0f}));
  builder.animate(animationName, box, AnimatedPath::Rotation, fullTurn());
  builder.animate(animationName, ball, AnimatedPath::Translation,
                  {Interpolation::Linear, {0, 4}, {{-2.3f, lift, 1.2f, 0.0f}, {2.3f, lift, 2.1f, 0.0f}}});
  builder.animate(animationName, board, AnimatedPath::Rotation, pendulum(50.0));
  builder.addCamera("Camera", {0.0, 3.2, 6.2}, {0.0, 0.6, 0.0}, 0.65, 4.0 / 3.0);
  return builder.take();
}

struct Recipe {
  BuiltinScene scene;
  GltfDocument (*make)();
};

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> list = {
      {{"shapes", "a ground and five smooth objects under a point light (9.8 k triangles)"}, makeShapesScene},
      {{"cornell", "a Cornell box with two boxes under an emissive ceiling light"}, makeCornellScene},
      {{"caustics", "a Cornell box with a solid glass sphere and a mirror box"}, makeCausticsScene},
      {{"rooms", "two closed rooms joined by a door, a light in one and the camera in the other"},
       makeRoomsScene},
      {{"rooms-sealed", "these two rooms with the door closed: the camera's room is dark"},
       makeSealedRoomsScene},
      {{"swing", "a turning box, a crossing ball and a swinging board under a lamp (an animation of 4 s)"},
       makeSwingScene},
      {{"shiny", "shapes with a polished ground, a ball and a ring of metal, and plastic otherwise"},
       makeShinyScene},
      {{"crowd",
        "25 objects of many colours, some of metal, under 20 coloured point lights (50 k triangles)"},
       [] { return makeCrowdScene(25, 20); }},
      {{"ocean", "a sea floor with a black pearl, rocks and coral, under water and eight lamps"},
       makeOceanScene},
      {{"lake", "a lake between shores under three low lamps"}, makeLakeScene},
      {{"bumps", "a ground of cobbles, a rough wall and a block, by normal maps, unfolded for light maps"},
       makeBumpsScene},
      {{"salon", "a furnished room with a French window, and the court behind it (196 k triangles)"},
       makeSalonScene},
  };
  return list;
}

}  // namespace

const std::vector<BuiltinScene>& builtinScenes() {
  static const std::vector<BuiltinScene> scenes = [] {
    std::vector<BuiltinScene> list;
    for (const Recipe& recipe : recipes()) list.push_back(recipe.scene);
    return list;
  }();
  return scenes;
}

GltfDocument makeBuiltinScene(const std::string& name) {
  std::vector<std::string> names;
  std::string known;
  for (const Recipe& recipe : recipes()) {
    if (recipe.scene.name == name) return recipe.make();
    names.push_back(recipe.scene.name);
    known += (known.empty() ? "" : ", ") + recipe.scene.name;
  }
  throw UsageError("scene", "no built-in scene \"" + name + "\"",
                   didYouMean(name, names) + "known scenes: " + known);
}

}  // namespace prelight
