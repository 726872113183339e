#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/builtin/salon_parts.h"
#include "scene/builtin/surface_maps.h"

namespace prelight {
namespace {

using namespace salon;
using Textures = SalonTextures;

double randomOf(int i, int k, std::uint32_t seed) { return static_cast<double>(hashed(i, k, seed)); }

constexpr double shelfDepth = 0.3, shelfFront = -1.55, shelfLength = 1.7, shelfBoard = 0.026;
constexpr double shelfTops[] = {0.12, 0.50, 0.86, 1.20, 1.54, 1.88};

/// Adds a book case along the left wall, open at the front.
void addBookcase(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject shelves;
  const double x = left + 0.5 * shelfDepth + 0.012, middle = shelfFront + 0.5 * shelfLength, tall = 2.16;
  const auto board = [&](const glm::dvec3& size, const glm::dvec3& at) {
    shelves.addBox({size, 0.0035, 1, 0.12}, Textures::wood, at);
  };
  for (const double top : shelfTops)
    board({shelfDepth - 0.01, shelfBoard, shelfLength - 2.0 * shelfBoard},
          {x, top - 0.5 * shelfBoard, middle});
  board({shelfDepth + 0.03, 0.034, shelfLength + 0.04}, {x + 0.005, tall, middle});
  board({0.016, tall - 0.1, shelfLength - 0.02}, {left + 0.012, 0.5 * tall + 0.04, middle});
  for (const double side : {-0.5, 0.5})
    board({shelfDepth, tall - 0.018, shelfBoard},
          {x, 0.5 * (tall - 0.017), middle + side * (shelfLength - shelfBoard)});
  board({shelfDepth - 0.01, tall - 0.16, shelfBoard}, {x - 0.002, 0.5 * tall + 0.05, middle});
  board({shelfDepth - 0.03, 0.09, shelfLength - 0.06}, {x - 0.01, 0.05, middle});
  builder.addUnfolded("Bookcase", shelves.shape(), m.walnut);
}

/// Returns a book that stands with its back to +x: boards, back and pages.
void addBook(SalonObject& binding, SalonObject& pages, const glm::dvec3& size, const glm::dmat3& turn,
             const glm::dvec3& at) {
  constexpr double board = 0.003;
  const glm::dvec3 half = 0.5 * size;
  const auto part = [&](SalonObject& to, const glm::dvec3& extent, const glm::dvec3& offset) {
    to.addPlainBox(extent, turn, at + turn * offset);
  };
  part(binding, {size.x, size.y, board}, {0.0, 0.0, half.z - 0.5 * board});
  part(binding, {size.x, size.y, board}, {0.0, 0.0, 0.5 * board - half.z});
  part(binding, {0.004, size.y, size.z}, {half.x + 0.002, 0.0, 0.0});
  part(pages, {size.x - 0.008, size.y - 0.008, size.z - 2.0 * board - 0.0006}, {-0.002, 0.0, 0.0});
}

/// Fills the shelves with books; every now and then a gap, a leaning or a lying book.
void addBooks(GltfBuilder& builder, const SalonMaterials& m) {
  SalonObject bindings[6], pages;
  int number = 0;
  const double x = left + 0.012 + 0.02;
  for (int shelf = 0; shelf < 6; ++shelf)
    for (int bay = 0; bay < 2; ++bay) {
      const double from = shelfFront + shelfBoard + bay * 0.5 * shelfLength + 0.006;
      const double to = from + 0.5 * shelfLength - 1.5 * shelfBoard - 0.012;
      double z = from;
      const double filled = to - (0.04 + 0.3 * randomOf(shelf, bay, 3));
      double tall = 0.24, wide = 0.17;
      int kind = 0, inSet = 0;
      while (z < filled) {
        if (inSet-- <= 0) {  // a set of books of one size and binding
          inSet = 1 + static_cast<int>(4.0 * randomOf(number, 1, 7));
          tall = (shelf == 0 ? 0.26 : 0.2) + 0.07 * randomOf(number, 2, 7);
          wide = 0.13 + 0.06 * randomOf(number, 3, 7);
          kind = static_cast<int>(6.0 * randomOf(number, 4, 7));
        }
        const double thick = 0.018 + 0.03 * randomOf(number, 5, 7);
        if (z + thick > filled) break;
        const double deep = x + wide + 0.02 * randomOf(number, 6, 7);
        addBook(bindings[kind], pages, {wide, tall, thick}, glm::dmat3(1.0),
                {deep - 0.5 * wide, shelfTops[shelf] + 0.5 * tall + 0.0005, z + 0.5 * thick});
        z += thick + 0.0008;
        ++number;
      }
      if (to - z > 0.12) {  // one leans on the others
        const double lean = 14.0 * degrees, h = 0.215, t = 0.026;
        addBook(bindings[(shelf + bay * 3) % 6], pages, {0.15, h, t}, rotationAbout({1.0, 0.0, 0.0}, -lean),
                {x + 0.09, shelfTops[shelf] + 0.5 * h * std::cos(lean) + 0.5 * t * std::sin(lean) + 0.001,
                 z + 0.5 * h * std::sin(lean) + 0.5 * t * std::cos(lean) + 0.002});
      }
    }
  for (int i = 0; i < 6; ++i)
    builder.addUnfolded("Books " + std::to_string(i), bindings[i].shape(), m.books[i]);
  builder.addUnfolded("Pages", pages.shape(), m.paper);
}

/// Returns a leg that is square at the top and tapers, centred at the origin, standing on y = 0.
MeshShape makeLeg(double tall, double top, double foot) {
  MeshShape leg = makeRoundedBox({{top, tall, top}, 0.004, 1, 0.12});
  for (glm::vec3& p : leg.positions) {
    const double y = p.y + 0.5 * tall, share = glm::mix(foot / top, 1.0, std::min(1.0, y / (0.85 * tall)));
    p = glm::vec3(p.x * share, y, p.z * share);
  }
  return leg;
}

void addChair(GltfBuilder& builder, const SalonMaterials& m, const std::string& name, const glm::vec3& at,
              double yaw) {
  SalonObject wood;
  constexpr double seat = 0.44, w = 0.42, d = 0.42;
  const double side = Textures::wood;
  for (const double x : {-1.0, 1.0}) {
    wood.add(makeLeg(seat - 0.02, 0.036, 0.024), side, {x * (0.5 * w - 0.025), 0.0, 0.5 * d - 0.03});
    // Rear legs run on as the posts of the back, which leans.
    MeshShape post = makeRoundedBox({{0.032, 0.94, 0.032}, 0.005, 2, 0.06});
    for (glm::vec3& p : post.positions) {
      p.y += 0.47f;
      const double over = std::max(0.0, p.y - seat), under = std::max(0.0, seat - p.y);
      p.z -= static_cast<float>(0.16 * over + 0.5 * over * over * 0.3 + 0.14 * under);
    }
    wood.add(post, side, {x * (0.5 * w - 0.022), 0.0, -0.5 * d + 0.03});
    wood.addBox({{0.022, 0.055, d - 0.08}, 0.003, 1, 0.1}, side, {x * (0.5 * w - 0.025), seat - 0.055, 0.0});
  }
  wood.addBox({{w - 0.07, 0.055, 0.022}, 0.003, 1, 0.1}, side, {0.0, seat - 0.055, 0.5 * d - 0.03});
  wood.addBox({{w - 0.07, 0.055, 0.022}, 0.003, 1, 0.1}, side, {0.0, seat - 0.055, -0.5 * d + 0.03});
  for (int i = 0; i < 3; ++i) {  // slats, bent towards the back
    const double y = 0.60 + 0.125 * i, over = y - seat;
    MeshShape slat = makeRoundedBox({{w - 0.06, i == 2 ? 0.075 : 0.045, 0.014}, 0.005, 2, 0.03});
    for (glm::vec3& p : slat.positions)
      p.z -= static_cast<float>(0.03 * (1.0 - std::pow(p.x / (0.5 * w), 2.0)));
    wood.add(slat, side, {0.0, y, -0.5 * d + 0.034 - 0.16 * over - 0.15 * over * over});
  }
  builder.addUnfolded(name, wood.shape(), m.walnut, at, yaw);
  SalonObject pad;
  pad.add(makeRoundedBox({{w - 0.012, 0.05, d - 0.02}, 0.021, 3, 0.06}), Textures::fabric,
          {0.0, seat - 0.004, 0.008});
  builder.addUnfolded(name + " seat", pad.shape(), m.linen, at, yaw);
}

void addArmchair(GltfBuilder& builder, const SalonMaterials& m, const glm::vec3& at, double yaw) {
  SalonObject cover, legs;
  const double side = Textures::fabric;
  const auto block = [&](const glm::dvec3& size, double radius, const glm::dvec3& where, double lean = 0.0) {
    cover.add(makeRoundedBox({size, radius, 3, 0.1}), side, rotationAbout({1.0, 0.0, 0.0}, -lean), where);
  };
  block({0.78, 0.2, 0.72}, 0.04, {0.0, 0.25, 0.0});
  block({0.53, 0.16, 0.58}, 0.06, {0.0, 0.415, 0.06});
  block({0.15, 0.42, 0.74}, 0.065, {-0.335, 0.40, 0.01});
  block({0.15, 0.42, 0.74}, 0.065, {0.335, 0.40, 0.01});
  block({0.72, 0.72, 0.17}, 0.075, {0.0, 0.53, -0.33}, 9.0 * degrees);
  block({0.52, 0.46, 0.15}, 0.07, {0.0, 0.68, -0.225}, 11.0 * degrees);
  for (const double x : {-0.32, 0.32})
    for (const double z : {-0.29, 0.29}) legs.add(makeLeg(0.16, 0.045, 0.028), Textures::wood, {x, 0.0, z});
  builder.addUnfolded("Armchair", cover.shape(), m.velvet, at, yaw);
  builder.addUnfolded("Armchair legs", legs.shape(), m.walnut, at, yaw);
  SalonObject pillow;
  pillow.add(makePillow({0.42, 0.42, 0.16}, 20), side,
             rotationAbout({0.0, 1.0, 0.0}, 14.0 * degrees) *
                 rotationAbout({1.0, 0.0, 0.0}, -22.0 * degrees) *
                 rotationAbout({0.0, 0.0, 1.0}, 8.0 * degrees),
             {0.05, 0.70, 0.01});
  builder.addUnfolded("Cushion", pillow.shape(), m.linen, at, yaw);
}

/// Adds a console below the mirror, with the lamp and a vase of twigs.
void addConsole(GltfBuilder& builder, const SalonMaterials& m) {
  const glm::dvec3 at(1.62, 0.0, back + 0.215);
  SalonObject wood;
  const double side = Textures::wood, tall = 0.82;
  wood.addBox({{1.06, 0.028, 0.36}, 0.006, 2, 0.09}, side, at + glm::dvec3(0.0, tall - 0.014, 0.0));
  wood.addBox({{0.98, 0.11, 0.02}, 0.003, 1, 0.1}, side, at + glm::dvec3(0.0, tall - 0.085, 0.14));
  for (const double x : {-0.47, 0.47}) {
    wood.addBox({{0.02, 0.11, 0.26}, 0.003, 1, 0.1}, side, at + glm::dvec3(x, tall - 0.085, 0.0));
    for (const double z : {-0.135, 0.135})
      wood.add(makeLeg(tall - 0.028, 0.042, 0.024), side, at + glm::dvec3(x, 0.0, z));
  }
  builder.addUnfolded("Console", wood.shape(), m.walnut);
}

/// Adds a lamp with a ceramic foot; its light is a point within the shade, which glows by itself.
void addLamp(GltfBuilder& builder, const SalonMaterials& m) {
  const glm::dvec3 at(1.98, 0.82, back + 0.23);
  const std::vector<glm::dvec2> foot = smoothCurve({{0.082, 0.003},
                                                    {0.083, 0.012},
                                                    {0.06, 0.024},
                                                    {0.024, 0.034},
                                                    {0.016, 0.06},
                                                    {0.02, 0.10},
                                                    {0.052, 0.16},
                                                    {0.058, 0.2},
                                                    {0.04, 0.25},
                                                    {0.014, 0.285},
                                                    {0.011, 0.33}},
                                                   4);
  std::vector<glm::dvec2> profile = {{0.0, 0.0005}, {0.08, 0.0005}};
  profile.insert(profile.end(), foot.begin(), foot.end());
  for (const glm::dvec2& p :
       {glm::dvec2(0.009, 0.332), {0.009, 0.36}, {0.018, 0.362}, {0.018, 0.40}, {0.0, 0.402}})
    profile.push_back(p);
  SalonObject stand;
  stand.add(makeTurned(profile, 48), 1.0, glm::dvec3(0.0));
  builder.addUnfolded("Lamp stand", stand.shape(), m.celadon, glm::vec3(at));
  // The shade is a cone without ends, 3 mm thick.
  constexpr double low = 0.36, high = 0.60, wide = 0.165, narrow = 0.12, thick = 0.003;
  std::vector<glm::dvec2> outside, inside;
  for (int i = 0; i <= 8; ++i) {
    const double t = i / 8.0;
    outside.emplace_back(glm::mix(wide, narrow, t), glm::mix(low, high, t));
    inside.emplace_back(glm::mix(narrow, wide, t) - thick, glm::mix(high, low, t));
  }
  builder.addUnfolded("Lamp shade", makeTurned(outside, 64), m.shade, glm::vec3(at));
  builder.addUnfolded("Inside of the shade", makeTurned(inside, 64), m.shadeInside, glm::vec3(at));
  MeshShape rims = makeTurned({{narrow, high}, {narrow - thick, high}}, 64);
  rims.add(makeTurned({{wide - thick, low}, {wide, low}}, 64));
  builder.addUnfolded("Rims of the shade", rims, m.brass, glm::vec3(at));
  Light light;
  light.name = "Lamp";
  light.type = LightType::Point;
  light.intensity = {14.0f, 9.4f, 4.9f};
  light.position = at + glm::dvec3(0.0, 0.47, 0.0);
  light.radius = 0.03f;
  builder.addLight(light);
}

}  // namespace

void addSalonFurniture(GltfBuilder& builder, const SalonMaterials& m) {
  addBookcase(builder, m);
  addBooks(builder, m);
  addConsole(builder, m);
  addLamp(builder, m);
  SalonObject rug;
  constexpr glm::dvec2 size(2.6, 1.7);
  MeshShape wool = makeRoundedBox({{size.x, 0.012, size.y}, 0.004, 1, 0.09});
  for (std::size_t i = 0; i < wool.positions.size(); ++i)
    wool.texCoords[i] = glm::vec2(wool.positions[i].x / size.x + 0.5, wool.positions[i].z / size.y + 0.5);
  builder.addUnfolded("Rug", wool, m.rug, {-0.35f, 0.007f, 0.15f}, 4.0 * degrees);
  addArmchair(builder, m, {-1.3f, 0.012f, 0.0f}, 62.0 * degrees);
  addChair(builder, m, "Chair", {0.42f, 0.013f, -0.02f}, 25.0 * degrees);
}

}  // namespace prelight
