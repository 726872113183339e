#include <cmath>
#include <numbers>

#include "scene/builtin/salon_parts.h"
#include "scene/builtin/surface_maps.h"

namespace prelight {
namespace {

using namespace salon;
using Textures = SalonTextures;
constexpr double outside = back - wall, courtBack = -9.2, courtLeft = -4.6, courtRight = 3.4;
constexpr double archLeft = -1.5, archRight = 0.1, archSpring = 1.75, terrace = courtLevel + 0.6;

void addGround(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject paving;
  const double width = courtRight - courtLeft;
  paving.addSurface({courtRight, courtLevel, outside}, {0.0, 0.0, courtBack - outside}, {-width, 0.0, 0.0},
                    0.11, Textures::paving);
  builder.addUnfolded("Paving", paving.shape(), m.paving);
  SalonObject steps;
  // The threshold of the window, and the step before it.
  steps.addBox({{windowRight - windowLeft + 0.02, 0.05, wall + 0.06}, 0.006, 2, 0.07}, Textures::paving,
               {0.5 * (windowLeft + windowRight), -0.022, 0.5 * (back + outside) - 0.03});
  steps.addBox({{2.8, 0.1, 0.5}, 0.012, 1, 0.15}, Textures::paving,
               {0.5 * (windowLeft + windowRight), courtLevel + 0.045, outside - 0.25});
  // Four steps lead up to the gate.
  for (int i = 0; i < 4; ++i) {
    const double tread = 0.32, deep = tread * (4 - i);
    steps.addBox({{2.3, 0.15, deep}, 0.012, 1, 0.15}, Textures::paving,
                 {0.5 * (archLeft + archRight), courtLevel + 0.15 * i + 0.075, courtBack + 0.5 * deep});
  }
  builder.addUnfolded("Steps", steps.shape(), m.paving);
}

/// Returns the wall with the gate: strips beside it and a round arch above it.
MeshShape makeGateWall(double top) {
  SalonObject face;
  const double cell = 0.12, side = Textures::ashlar, z = courtBack;
  face.addSurface({courtLeft, courtLevel, z}, {archLeft - courtLeft, 0.0, 0.0}, {0.0, top - courtLevel, 0.0},
                  cell, side);
  face.addSurface({archRight, courtLevel, z}, {courtRight - archRight, 0.0, 0.0},
                  {0.0, top - courtLevel, 0.0}, cell, side);
  constexpr int columns = 24;
  const double radius = 0.5 * (archRight - archLeft), middle = 0.5 * (archLeft + archRight);
  const auto edge = [&](int i) {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(i) / columns);
    return glm::dvec3(middle + radius * std::cos(angle), archSpring + radius * std::sin(angle), z);
  };
  for (int i = 0; i < columns; ++i) {
    const glm::dvec3 a = edge(i), b = edge(i + 1);
    MeshShape above;
    const auto addQuad = [&](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r,
                             const glm::dvec3& s) {
      const auto first = static_cast<std::uint32_t>(above.positions.size());
      const glm::dvec3 normal = glm::normalize(glm::cross(q - p, s - p));
      for (const glm::dvec3& corner : {p, q, r, s}) {
        above.positions.emplace_back(corner);
        above.normals.emplace_back(normal);
        above.texCoords.emplace_back((corner.x + corner.z) / side, -corner.y / side);
      }
      above.triangles.emplace_back(first, first + 1, first + 2);
      above.triangles.emplace_back(first, first + 2, first + 3);
    };
    addQuad(a, b, {b.x, top, z}, {a.x, top, z});
    const glm::dvec3 deep(0.0, 0.0, -0.4);
    addQuad(a, a + deep, b + deep, b);  // the underside of the arch
    face.shape().add(above);
  }
  face.addSurface({archLeft, terrace, z}, {0.0, 0.0, -0.4}, {0.0, archSpring - terrace, 0.0}, cell, side);
  face.addSurface({archRight, terrace, z - 0.4}, {0.0, 0.0, 0.4}, {0.0, archSpring - terrace, 0.0}, cell,
                  side);
  return face.shape();
}

void addWalls(GltfBuilder& builder, const SalonMaterials& m) {
  constexpr double gateTop = 2.95, sideTop = 4.3;
  const glm::dvec3 deep(0.0, 0.0, courtBack - outside);
  SalonObject stucco, stone, coping;
  stucco.addSurface({courtLeft, courtLevel, outside}, deep, {0.0, sideTop - courtLevel, 0.0}, 0.13,
                    Textures::plaster);
  stucco.addSurface({courtRight, courtLevel, courtBack}, -deep, {0.0, sideTop - courtLevel, 0.0}, 0.13,
                    Textures::plaster);
  // The house's own front, around the window.
  const auto facade = [&](double from, double to, double low, double top) {
    stucco.addSurface({to, low, outside}, {from - to, 0.0, 0.0}, {0.0, top - low, 0.0}, 0.15,
                      Textures::plaster);
  };
  facade(courtLeft, windowLeft, courtLevel, sideTop);
  facade(windowRight, courtRight, courtLevel, sideTop);
  facade(windowLeft, windowRight, windowHeight, sideTop);
  builder.addUnfolded("Court walls", stucco.shape(), m.stucco);
  builder.addUnfolded("Gate wall", makeGateWall(gateTop), m.ashlar);
  const auto cope = [&](const glm::dvec3& size, const glm::dvec3& at) {
    coping.addBox({size, 0.015, 1, 0.4}, Textures::ashlar, at);
  };
  cope({courtRight - courtLeft, 0.09, 0.5},
       {0.5 * (courtLeft + courtRight), gateTop + 0.045, courtBack - 0.18});
  for (const double x : {courtLeft, courtRight})
    cope({0.5, 0.09, outside - courtBack},
         {x + (x < 0.0 ? -0.2 : 0.2), sideTop + 0.045, 0.5 * (outside + courtBack)});
  builder.addUnfolded("Coping", coping.shape(), m.ashlar);
  SalonObject garden;
  garden.addSurface({4.5, terrace - 0.002, courtBack}, {0.0, 0.0, -6.0}, {-10.5, 0.0, 0.0}, 0.75, 1.0);
  builder.addUnfolded("Garden", garden.shape(), m.earth);
}

MeshShape makePot(double radius, double tall) {
  std::vector<glm::dvec2> profile = {{0.0, 0.0},
                                     {0.62 * radius, 0.0},
                                     {0.64 * radius, 0.01},
                                     {0.93 * radius, 0.8 * tall},
                                     {1.04 * radius, 0.81 * tall},
                                     {1.06 * radius, 0.99 * tall},
                                     {1.04 * radius, tall},
                                     {0.9 * radius, tall},
                                     {0.88 * radius, 0.9 * tall},
                                     {0.0, 0.91 * tall}};
  return makeTurned(profile, 36);
}

/// Adds an olive tree: a trunk, branches that fork, and a crown.
void addTree(MeshShape& wood, MeshShape& leaves, const glm::dvec3& foot, double tall, std::uint32_t seed,
             int count) {
  const auto random = [&](int i, int k) { return static_cast<double>(hashed(i, k, seed)); };
  std::vector<BranchPoint> trunk;
  const auto trunkAt = [&](double t) {
    return foot + glm::dvec3(0.10 * std::sin(3.0 * t + seed), 0.55 * tall * t, 0.08 * std::sin(4.0 * t));
  };
  for (int i = 0; i <= 8; ++i)
    trunk.push_back({trunkAt(i / 8.0), 0.075 * tall * 0.45 * (1.25 - 0.6 * i / 8.0)});
  wood.add(makeBranch(trunk, 12));
  constexpr int branches = 9;
  for (int i = 0; i < branches; ++i) {
    const double turn = 2.4 * i + random(i, 0), reach = tall * (0.2 + 0.12 * random(i, 1)),
                 rise = tall * (0.22 + 0.2 * random(i, 2));
    const glm::dvec3 from = trunkAt(0.6 + 0.4 * i / branches), out(std::cos(turn), 0.0, std::sin(turn));
    std::vector<BranchPoint> points;
    for (int k = 0; k <= 6; ++k) {
      const double t = k / 6.0;
      points.push_back({from + out * reach * t +
                            glm::dvec3(0.02 * std::sin(9.0 * t + i), rise * t * (1.15 - 0.15 * t), 0.0),
                        0.018 * tall * 0.45 * (1.1 - t)});
    }
    wood.add(makeBranch(points, 7));
    addLeafCloud(leaves, {.centre = points[5].position,
                          .radius = glm::dvec3(0.17, 0.14, 0.17) * tall,
                          .hollow = 0.15,
                          .size = 0.085,
                          .count = count / branches,
                          .seed = seed + static_cast<std::uint32_t>(i) + 1});
  }
  addLeafCloud(leaves, {.centre = foot + glm::dvec3(0.0, 0.95 * tall, 0.0),
                        .radius = glm::dvec3(0.24, 0.18, 0.24) * tall,
                        .hollow = 0.3,
                        .size = 0.085,
                        .count = count / 4,
                        .seed = seed + 60});
}

/// Adds a pot of a radius and a height at a place, and leaves above it: their centre counts from there.
void addPotted(SalonObject& pots, MeshShape& leaves, const glm::dvec2& pot, const glm::dvec3& at,
               LeafCloud crown) {
  pots.add(makePot(pot.x, pot.y), 1.0, at);
  crown.centre += at;
  addLeafCloud(leaves, crown);
}

void addPlants(GltfBuilder& builder, const SalonMaterials& m) {
  MeshShape wood, olive, hedge, ivy;
  SalonObject pots, earth;
  addTree(wood, olive, {-2.9, courtLevel + 0.05, -6.4}, 2.9, 5, 2600);
  addTree(wood, hedge, {-3.6, terrace, -11.8}, 5.2, 23, 1100);
  addTree(wood, hedge, {1.9, terrace, -12.2}, 5.6, 31, 1100);
  addLeafCloud(hedge, {.centre = {-0.7, terrace + 0.7, -14.0},
                       .radius = {4.0, 1.2, 1.0},
                       .hollow = 0.6,
                       .size = 0.16,
                       .count = 1000,
                       .seed = 9});
  for (const double x : {-1.0, 1.0}) {
    const glm::dvec3 at(0.5 * (archLeft + archRight) + 1.5 * x, courtLevel, courtBack + 1.0);
    addPotted(pots, hedge, {0.27, 0.46}, at,
              {.centre = {0.0, 0.78, 0.0},
               .radius = {0.36, 0.38, 0.36},
               .hollow = 0.75,
               .size = 0.07,
               .count = 700,
               .seed = 40 + static_cast<std::uint32_t>(x + 1.0)});
  }
  addPotted(pots, olive, {0.21, 0.36}, {0.95, courtLevel, -4.1},
            {.centre = {0.0, 0.6, 0.0},
             .radius = {0.34, 0.36, 0.34},
             .hollow = 0.2,
             .size = 0.1,
             .count = 420,
             .seed = 50});
  for (int i = 0; i < 1700; ++i) {  // ivy on the left wall
    const auto random = [&](int k) { return static_cast<double>(hashed(i, k, 88)); };
    const double z = -7.9 + 2.7 * random(0), crest = 1.9 + 1.3 * std::sin(1.7 * z) + 0.5 * std::sin(5.0 * z);
    const double y = courtLevel + (0.3 + crest) * std::pow(random(1), 0.8);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1.0, 0.5 + random(2), random(3) - 0.5));
    const glm::dvec3 down(random(4) - 0.5, -1.0, 1.2 * (random(5) - 0.5));
    addLeaf(ivy, {courtLeft + 0.015 + 0.09 * random(6), y, z},
            glm::normalize(down - normal * glm::dot(down, normal)), normal, 0.07 + 0.05 * random(7));
  }
  builder.addUnfolded("Trunks", wood, m.bark);
  builder.addUnfolded("Olive leaves", olive, m.leaves[0]);
  builder.addUnfolded("Hedge leaves", hedge, m.leaves[1]);
  builder.addUnfolded("Ivy", ivy, m.leaves[2]);
  builder.addUnfolded("Pots", pots.shape(), m.terracotta);
}

}  // namespace

void addSalonCourt(GltfBuilder& builder, const SalonMaterials& m) {
  addGround(builder, m);
  addWalls(builder, m);
  addPlants(builder, m);
  SalonObject bench;
  bench.addBox({{0.42, 0.07, 1.7}, 0.012, 2, 0.08}, Textures::ashlar,
               {courtLeft + 0.5, courtLevel + 0.44, -4.4});
  for (const double z : {-5.0, -3.8})
    bench.addBox({{0.34, 0.4, 0.16}, 0.01, 1, 0.1}, Textures::ashlar,
                 {courtLeft + 0.5, courtLevel + 0.203, z});
  builder.addUnfolded("Bench", bench.shape(), m.ashlar);
}

}  // namespace prelight
