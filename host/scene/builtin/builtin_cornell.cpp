#include "scene/builtin/builtin_scenes.h"
#include "scene/builtin/gltf_builder.h"

namespace prelight {

namespace {

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

}  // namespace

GltfDocument makeCornellScene() {
  GltfBuilder builder("cornell");
  addRoom(builder);
  const int white = builder.addDiffuse("Box", {0.73f, 0.73f, 0.73f});
  builder.addObject("Tall box", makeBox({0.6, 1.2, 0.6}, 12, false), white, {-0.34f, 0.0f, -0.3f}, 0.3);
  builder.addObject("Short box", makeBox({0.6, 0.6, 0.6}, 12, false), white, {0.34f, 0.0f, 0.35f}, -0.3);
  return builder.take();
}

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

}  // namespace prelight
