#include <cmath>
#include <numbers>

#include "scene/builtin/salon_parts.h"
#include "scene/builtin/surface_maps.h"

namespace prelight {
namespace {

using salon::degrees;
using Textures = SalonTextures;
constexpr double tableTop = 0.745;
const glm::dvec3 centre(1.22, 0.0, 0.95);

void addTable(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject wood;
  const double side = Textures::wood;
  wood.addBox({{1.05, 0.032, 1.5}, 0.008, 2, 0.07}, side, {0.0, tableTop - 0.016, 0.0});
  for (const double x : {-0.44, 0.44}) {
    wood.addBox({{0.022, 0.09, 1.26}, 0.003, 1, 0.1}, side, {x, tableTop - 0.077, 0.0});
    for (const double z : {-0.66, 0.66}) {
      MeshShape leg = makeRoundedBox({{0.062, tableTop - 0.033, 0.062}, 0.006, 2, 0.1});
      for (glm::vec3& p : leg.positions) {
        const float share =
            0.62f + 0.38f * std::min(1.0f, (p.y / static_cast<float>(tableTop) + 0.5f) / 0.8f);
        p.x *= share;
        p.z *= share;
      }
      wood.add(leg, side, {x, 0.5 * (tableTop - 0.033), z});
    }
  }
  for (const double z : {-0.66, 0.66})
    wood.addBox({{0.82, 0.09, 0.022}, 0.003, 1, 0.1}, side, {0.0, tableTop - 0.077, z});
  builder.addUnfolded("Table", wood.shape(), m.walnut, glm::vec3(centre), -6.0 * degrees);
}

/// Returns a vessel of this thickness from its outer profile, which begins at the foot's rim and ends at the
/// mouth.
MeshShape makeVessel(const std::vector<glm::dvec2>& outer, double thickness, double floor, int segments) {
  std::vector<glm::dvec2> profile = {{0.0, outer.front().y}};
  profile.insert(profile.end(), outer.begin(), outer.end());
  // The lip is a half circle.
  const glm::dvec2 mouth = outer.back();
  for (int i = 1; i < 4; ++i) {
    const double angle = std::numbers::pi * i / 4.0;
    profile.emplace_back(mouth.x - 0.5 * thickness + 0.5 * thickness * std::cos(angle),
                         mouth.y + 0.5 * thickness * std::sin(angle));
  }
  for (std::size_t i = outer.size(); i-- > 0;) {
    if (outer[i].y <= floor) break;
    profile.emplace_back(std::max(0.001, outer[i].x - thickness), outer[i].y);
  }
  const double inner = profile.back().x;
  profile.emplace_back(0.6 * inner, floor - 0.002);
  profile.emplace_back(0.0, floor - 0.003);
  return makeTurned(profile, segments);
}

void addVessels(GltfBuilder& builder, const SalonMaterials& m) {
  const std::vector<glm::dvec2> bowl = smoothCurve({{0.05, 0.0},
                                                    {0.052, 0.006},
                                                    {0.042, 0.014},
                                                    {0.06, 0.026},
                                                    {0.11, 0.052},
                                                    {0.148, 0.09},
                                                    {0.156, 0.105}},
                                                   4);
  builder.addUnfolded("Bowl", makeVessel(bowl, 0.0035, 0.022, 64), m.brass,
                      {1.2f, static_cast<float>(tableTop) + 0.001f, 0.86f});
  const std::vector<glm::dvec2> carafe = smoothCurve({{0.046, 0.0},
                                                      {0.056, 0.006},
                                                      {0.062, 0.04},
                                                      {0.058, 0.10},
                                                      {0.03, 0.165},
                                                      {0.025, 0.2},
                                                      {0.028, 0.235},
                                                      {0.04, 0.265}},
                                                     4);
  builder.addUnfolded("Carafe", makeVessel(carafe, 0.0028, 0.012, 48), m.glass,
                      {0.92f, static_cast<float>(tableTop) + 0.001f, 0.62f});
  const std::vector<glm::dvec2> tumbler =
      smoothCurve({{0.028, 0.0}, {0.031, 0.003}, {0.033, 0.03}, {0.036, 0.09}}, 5);
  builder.addUnfolded("Tumbler", makeVessel(tumbler, 0.0022, 0.014, 48), m.glass,
                      {1.06f, static_cast<float>(tableTop) + 0.001f, 0.52f});
  const std::vector<glm::dvec2> vase = smoothCurve({{0.05, 0.0},
                                                    {0.056, 0.006},
                                                    {0.085, 0.07},
                                                    {0.092, 0.13},
                                                    {0.06, 0.2},
                                                    {0.034, 0.235},
                                                    {0.036, 0.262}},
                                                   4);
  builder.addUnfolded("Vase", makeVessel(vase, 0.005, 0.02, 48), m.porcelain,
                      {1.5f, static_cast<float>(tableTop) + 0.001f, 0.55f});
}

void addFruit(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject oranges, lemons;
  const auto ball = [](double radius) {
    return makeTurned(smoothCurve({{0.0, -radius},
                                   {0.7071 * radius, -0.7071 * radius},
                                   {radius, 0.0},
                                   {0.7071 * radius, 0.7071 * radius},
                                   {0.0, 0.96 * radius}},
                                  4),
                      24);
  };
  const glm::dvec3 at(1.2, tableTop, 0.86);
  for (const glm::dvec3& p :
       {glm::dvec3(-0.045, 0.075, 0.035), {0.05, 0.076, 0.03}, {-0.005, 0.077, -0.055}, {0.002, 0.135, 0.0}})
    oranges.add(ball(0.039), 1.0, rotationAbout({0.3, 0.2, 1.0}, 9.0 * p.x + p.z), at + p);
  MeshShape lemon = makeTurned(smoothCurve({{0.0, -0.044},
                                            {0.007, -0.04},
                                            {0.024, -0.024},
                                            {0.029, 0.0},
                                            {0.024, 0.024},
                                            {0.007, 0.04},
                                            {0.0, 0.046}},
                                           4),
                               32);
  lemons.add(lemon, 1.0, rotationAbout({0.2, 0.3, 1.0}, 1.4), {1.01, tableTop + 0.030, 1.02});
  builder.addUnfolded("Oranges", oranges.shape(), m.orange);
  builder.addUnfolded("Lemon", lemons.shape(), m.lemon);
}

/// Adds three books in a pile.
void addPile(GltfBuilder& builder, const SalonMaterials& m) {
  const glm::dvec3 sizes[] = {{0.17, 0.032, 0.245}, {0.15, 0.024, 0.22}, {0.13, 0.028, 0.19}};
  const int kinds[] = {1, 4, 0};
  double y = tableTop + 0.001;
  SalonObject pages;
  for (int i = 0; i < 3; ++i) {
    const glm::dmat3 turn = rotationAbout({0.0, 1.0, 0.0}, (18.0 - 16.0 * i) * degrees);
    SalonObject binding;
    const glm::dvec3 at(1.42 + 0.006 * i, y + 0.5 * sizes[i].y, 1.28);
    const auto part = [&](SalonObject& to, const glm::dvec3& size, const glm::dvec3& offset, double radius) {
      to.add(makeRoundedBox({size, radius, 1, 0.12}), 1.0, turn, at + turn * offset);
    };
    const glm::dvec3& s = sizes[i];
    part(binding, {s.x, 0.003, s.z}, {0.0, 0.5 * s.y - 0.0015, 0.0}, 0.001);
    part(binding, {s.x, 0.003, s.z}, {0.0, 0.0015 - 0.5 * s.y, 0.0}, 0.001);
    part(binding, {0.006, s.y, s.z}, {-0.5 * s.x + 0.001, 0.0, 0.0}, 0.0028);
    part(pages, {s.x - 0.008, s.y - 0.0066, s.z - 0.008}, {0.002, 0.0, 0.0}, 0.0005);
    builder.addUnfolded("Pile " + std::to_string(i), binding.shape(), m.books[kinds[i]]);
    y += s.y + 0.0006;
  }
  builder.addUnfolded("Pages of the pile", pages.shape(), m.paper);
}

/// Adds olive twigs that stand in the vase.
void addTwigs(GltfBuilder& builder, const SalonMaterials& m) {
  MeshShape stems, leaves;
  const glm::dvec3 foot(1.5, tableTop + 0.03, 0.55);
  for (int i = 0; i < 7; ++i) {
    const double turn = 2.4 * i, lean = 0.10 + 0.16 * hashed(i, 0, 77), tall = 0.5 + 0.22 * hashed(i, 1, 77);
    const glm::dvec3 out(std::cos(turn), 0.0, std::sin(turn));
    const auto at = [&](double t) {
      return foot + out * (0.012 + lean * t * t * 1.5) + glm::dvec3(0.0, tall * t * (1.0 - 0.12 * t), 0.0);
    };
    std::vector<BranchPoint> points;
    for (int k = 0; k <= 10; ++k) points.push_back({at(k / 10.0), 0.0028 - 0.0018 * k / 10.0});
    stems.add(makeBranch(points, 6));
    for (int k = 0; k < 18; ++k) {
      const double t = 0.5 + 0.5 * k / 17.0, around = 2.0 * k + i;
      const glm::dvec3 along = glm::normalize(at(t) - at(t - 0.02));
      const glm::dvec3 side =
          glm::normalize(glm::cross(along, glm::dvec3(std::cos(around), 0.3, std::sin(around))));
      const glm::dvec3 way = glm::normalize(side + 0.8 * along + glm::dvec3(0.0, -0.25, 0.0));
      glm::dvec3 normal = glm::normalize(glm::cross(way, glm::cross(along, way)));
      if (normal.y < 0.0) normal = -normal;
      addLeaf(leaves, at(t), way, normal, 0.045 + 0.02 * hashed(i, k, 79));
    }
  }
  builder.addUnfolded("Twigs", stems, m.bark);
  builder.addUnfolded("Twig leaves", leaves, m.leaves[1]);
}

}  // namespace

void addSalonTable(GltfBuilder& builder, const SalonMaterials& m) {
  addTable(builder, m);
  addVessels(builder, m);
  addFruit(builder, m);
  addPile(builder, m);
  addTwigs(builder, m);
}

}  // namespace prelight
