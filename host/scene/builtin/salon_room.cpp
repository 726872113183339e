#include <cmath>
#include <numbers>

#include "scene/builtin/salon_parts.h"

namespace prelight {
namespace {

using namespace salon;
using Textures = SalonTextures;
constexpr double wallCell = 0.1;

/// Adds the outsides of the side walls, the front wall and the roof. The back wall's outside is the court's.
void addOutside(SalonObject& walls) {
  constexpr double coarse = 0.5;
  const double low = left - wall, high = right + wall, far = back - wall, near = front + wall;
  const glm::dvec3 up(0.0, roomHeight + wall, 0.0), deep(0.0, 0.0, near - far), wide(high - low, 0.0, 0.0);
  walls.addSurface({low, 0.0, far}, deep, up, coarse, Textures::plaster);
  walls.addSurface({high, 0.0, near}, -deep, up, coarse, Textures::plaster);
  walls.addSurface({low, 0.0, near}, wide, up, coarse, Textures::plaster);
  walls.addSurface({low, up.y, far}, deep, wide, coarse, Textures::plaster);
}

/// Returns the walls: each seen from inside, the back one with the window's opening, and from outside.
MeshShape makeWalls() {
  SalonObject walls;
  const glm::dvec3 up(0.0, roomHeight, 0.0);
  const auto surface = [&](const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    walls.addSurface(corner, u, v, wallCell, Textures::plaster);
  };
  surface({left, 0.0, front}, {0.0, 0.0, back - front}, up);
  surface({right, 0.0, back}, {0.0, 0.0, front - back}, up);
  surface({right, 0.0, front}, {left - right, 0.0, 0.0}, up);
  const glm::dvec3 opening(0.0, windowHeight, 0.0), lintel(0.0, roomHeight - windowHeight, 0.0);
  const auto strip = [&](double from, double to, double low, const glm::dvec3& tall) {
    surface({from, low, back}, {to - from, 0.0, 0.0}, tall);
  };
  strip(left, windowLeft, 0.0, opening);
  strip(windowRight, right, 0.0, opening);
  strip(left, windowLeft, windowHeight, lintel);
  strip(windowLeft, windowRight, windowHeight, lintel);
  strip(windowRight, right, windowHeight, lintel);
  const glm::dvec3 through(0.0, 0.0, -wall), across(windowRight - windowLeft, 0.0, 0.0);
  surface({windowLeft, 0.0, back}, through, opening);
  surface({windowRight, 0.0, back - wall}, -through, opening);
  surface({windowLeft, windowHeight, back - wall}, across, -through);
  addOutside(walls);
  return walls.shape();
}

/// Returns skirting boards and a cornice along all walls.
MeshShape makeMouldings() {
  SalonObject mouldings;
  const auto along = [&](double y, const glm::dvec2& section) {
    const double depth = section.x, tall = section.y;
    const double lengthZ = front - back, middleZ = 0.5 * (front + back);
    const RoundedBox side{{depth, tall, lengthZ}, 0.006, 1, 0.28};
    mouldings.addBox(side, 1.0, {left + 0.5 * depth, y, middleZ});
    mouldings.addBox(side, 1.0, {right - 0.5 * depth, y, middleZ});
    mouldings.addBox({{right - left, tall, depth}, 0.006, 1, 0.28}, 1.0, {0.0, y, front - 0.5 * depth});
    const auto behind = [&](double from, double to) {
      mouldings.addBox({{to - from, tall, depth}, 0.006, 1, 0.28}, 1.0,
                       {0.5 * (from + to), y, back + 0.5 * depth});
    };
    if (y > windowHeight) return behind(left, right);
    behind(left, windowLeft - 0.06);
    behind(windowRight + 0.06, right);
  };
  along(0.07, {0.02, 0.14});
  along(0.145, {0.012, 0.022});
  along(roomHeight - 0.04, {0.09, 0.08});
  along(roomHeight - 0.095, {0.045, 0.04});
  return mouldings.shape();
}

/// Returns a casement that reaches from (0, 0, 0) along x and y: stiles, rails and bars between 2 x rows
/// panes.
MeshShape makeCasement(double width, double tall, int rows) {
  constexpr double stile = 0.058, thick = 0.045, bar = 0.024, foot = 0.16;
  SalonObject casement;
  const auto post = [&](double x, double y, double w, double h, double depth) {
    casement.addBox({{w, h, depth}, 0.004, 1, 0.25}, 1.0, {x, y, 0.0});
  };
  const double base = rows > 1 ? foot : stile;
  post(0.5 * stile, 0.5 * tall, stile, tall, thick);
  post(width - 0.5 * stile, 0.5 * tall, stile, tall, thick);
  post(0.5 * width, 0.5 * base, width - 2.0 * stile, base, thick - 0.004);
  post(0.5 * width, tall - 0.5 * stile, width - 2.0 * stile, stile, thick - 0.004);
  const double inner = tall - base - stile;
  post(0.5 * width, base + 0.5 * inner, bar, inner, thick - 0.014);
  for (int i = 1; i < rows; ++i)
    post(0.5 * width, base + inner * i / rows, width - 2.0 * stile, bar, thick - 0.018);
  return casement.shape();
}

/// Adds the fixed frame, four casements, of which the middle two stand open, and a row of panes above.
void addWindow(GltfBuilder& builder, const SalonMaterials& m) {
  constexpr double depth = 0.075, z = back - 0.2, jamb = 0.05, transom = 2.02;
  const double middle = 0.5 * (windowLeft + windowRight), width = windowRight - windowLeft;
  SalonObject frame;
  const auto bar = [&](double x, double y, double w, double h) {
    frame.addBox({{w, h, depth}, 0.005, 1, 0.1}, 1.0, {x, y, z});
  };
  bar(windowLeft + 0.5 * jamb, 0.5 * windowHeight, jamb, windowHeight);
  bar(windowRight - 0.5 * jamb, 0.5 * windowHeight, jamb, windowHeight);
  bar(middle, windowHeight - 0.5 * jamb, width - 2.0 * jamb, jamb);
  bar(middle, transom, width - 2.0 * jamb, 0.06);
  const double leaf = (width - 2.0 * jamb) / 4.0, tall = transom - 0.03 - 0.025,
               upper = windowHeight - jamb - transom - 0.03;
  for (int i = 0; i < 4; ++i) {
    MeshShape light = makeCasement(leaf, upper, 1);
    place(light, {windowLeft + jamb + leaf * i, transom + 0.03, z});
    frame.shape().add(light);
    if (i == 1 || i == 2) continue;
    MeshShape fixed = makeCasement(leaf, tall, 4);
    place(fixed, {windowLeft + jamb + leaf * i, 0.025, z});
    frame.shape().add(fixed);
  }
  builder.addUnfolded("Window frame", frame.shape(), m.paint);
  MeshShape open = makeCasement(leaf - 0.004, tall - 0.006, 4);
  place(open, {0.0, 0.0, -0.03});
  const glm::vec3 hinge(windowLeft + jamb + leaf, 0.028, z - 0.01);
  builder.addUnfolded("Left casement", open, m.paint, hinge, 102.0 * degrees);
  MeshShape mirrored = makeCasement(leaf - 0.004, tall - 0.006, 4);
  place(mirrored, {-(leaf - 0.004), 0.0, -0.03});
  builder.addUnfolded("Right casement", mirrored, m.paint, {hinge.x + 2.0 * leaf, hinge.y, hinge.z},
                      -112.0 * degrees);
  SalonObject handles;
  handles.add(makeRoundedBox({{0.014, 0.11, 0.012}, 0.005, 2, 0.05}), 0.1,
              {windowLeft + jamb + leaf - 0.03, 1.05, z + 0.04});
  handles.add(makeRoundedBox({{0.014, 0.11, 0.012}, 0.005, 2, 0.05}), 0.1,
              {windowLeft + jamb + 3.0 * leaf + 0.03, 1.05, z + 0.04});
  builder.addUnfolded("Window handles", handles.shape(), m.brass);
}

void addCurtains(GltfBuilder& builder, const SalonMaterials& m) {
  constexpr double top = 2.66, z = back + 0.11;
  const auto curtain = [&](const char* name, double x, double turned) {
    MeshShape sheet = makeCurtain(0.5, top - 0.03, 0.04, 4);
    builder.addUnfolded(name, sheet, m.curtain, {x, 0.015, z}, turned);
  };
  curtain("Left curtain", windowLeft - 0.2, 0.0);
  curtain("Right curtain", windowRight + 0.22, 0.05);
  SalonObject rail;
  MeshShape rod = makeTurned({{0.0, 0.0}, {0.012, 0.0}, {0.012, 3.3}, {0.0, 3.3}}, 16);
  rail.add(rod, 1.0, rotationAbout({0.0, 0.0, 1.0}, 90.0 * degrees), {windowRight + 0.56, top + 0.02, z});
  for (const double x : {windowLeft - 0.54, windowRight + 0.56}) {
    MeshShape knob = makeSphere(0.026f, 16, 10);
    knob.texCoords.assign(knob.positions.size(), glm::vec2(0.0f));
    place(knob, {x, top + 0.02 - 0.026, z});
    rail.shape().add(knob);
  }
  builder.addUnfolded("Curtain rail", rail.shape(), m.brass);
}

/// Adds the mirror over the console, and the picture on the right wall, each with a frame.
void addFrames(GltfBuilder& builder, const SalonMaterials& m) {
  const auto frameOf = [](double width, double tall, double border, double thick) {
    SalonObject frame;
    const auto strip = [&](double x, double y, double w, double h) {
      frame.addBox({{w, h, thick}, 0.008, 1, 0.3}, 1.0, {x, y, 0.5 * thick});
      const double inner = 0.35;
      frame.addBox({{w > h ? w : w * inner, h > w ? h : h * inner, thick + 0.018}, 0.006, 1, 0.3}, 1.0,
                   {x, y, 0.5 * (thick + 0.018)});
    };
    strip(0.0, 0.5 * (tall + border), width + 2.0 * border, border);
    strip(0.0, -0.5 * (tall + border), width + 2.0 * border, border);
    strip(0.5 * (width + border), 0.0, border, tall);
    strip(-0.5 * (width + border), 0.0, border, tall);
    return frame.shape();
  };
  const glm::vec3 mirror(1.62f, 1.62f, back + 0.006f);
  SalonObject pane;
  pane.addSurface({-0.36, -0.5, 0.012}, {0.72, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.1, 1.0);
  builder.addUnfolded("Mirror", pane.shape(), m.mirror, mirror);
  builder.addUnfolded("Mirror frame", frameOf(0.70, 0.98, 0.055, 0.03), m.gilt, mirror);
  const glm::vec3 picture(right - 0.006, 1.62f, 0.15f);
  MeshShape canvas = makeGrid({-0.5, -0.36, 0.012}, {1.0, 0.0, 0.0}, {0.0, 0.72, 0.0}, 16, 12);
  builder.addUnfolded("Picture", canvas, m.picture, picture, -90.0 * degrees);
  builder.addUnfolded("Picture frame", frameOf(0.98, 0.70, 0.06, 0.03), m.walnut, picture, -90.0 * degrees);
}

/// Adds a door with six panels in the wall behind the camera, which the mirror shows.
void addDoor(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject door;
  const double z = front;
  const auto board = [&](double x, double y, double w, double h, double thick) {
    door.addBox({{w, h, thick}, 0.006, 1, 0.15}, 1.0, {x, y, z - 0.5 * thick});
  };
  const double x = 0.9;
  board(x, 1.03, 0.86, 2.06, 0.02);
  for (int row = 0; row < 3; ++row)
    for (const double side : {-1.0, 1.0}) board(x + side * 0.2, 0.42 + 0.62 * row, 0.3, 0.5, 0.034);
  board(x - 0.48, 1.06, 0.1, 2.12, 0.05);
  board(x + 0.48, 1.06, 0.1, 2.12, 0.05);
  board(x, 2.17, 1.06, 0.11, 0.05);
  builder.addUnfolded("Door", door.shape(), m.paint);
}

}  // namespace

void addSalonRoom(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject floor;
  // Boards run towards the window.
  floor.addSurface({right, 0.0, front}, {0.0, 0.0, back - front}, {left - right, 0.0, 0.0}, 0.07,
                   Textures::parquet);
  builder.addUnfolded("Floor", floor.shape(), m.parquet);
  builder.addUnfolded("Walls", makeWalls(), m.plaster);
  SalonObject ceiling;
  ceiling.addSurface({left, roomHeight, back}, {right - left, 0.0, 0.0}, {0.0, 0.0, front - back}, 0.12, 1.0);
  builder.addUnfolded("Ceiling", ceiling.shape(), m.ceiling);
  builder.addUnfolded("Mouldings", makeMouldings(), m.paint);
  addWindow(builder, m);
  addCurtains(builder, m);
  addFrames(builder, m);
  addDoor(builder, m);
}

}  // namespace prelight
