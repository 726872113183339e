#include "scene/builtin/salon_materials.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/builtin/surface_maps.h"

namespace prelight {
namespace {

constexpr float wholeTurn = 2.0f * std::numbers::pi_v<float>;

float fractionOf(float x) { return x - std::floor(x); }

float smoothStep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// Returns oak or walnut, by its light and dark colour, with the grain along u; `seed` picks the board.
SurfacePoint woodGrain(float u, float v, const glm::vec3& light, const glm::vec3& dark, std::uint32_t seed) {
  const float warp = tiledTurbulence(u, v, 2, 6, 3, seed);
  const float rings = 0.5f + 0.5f * std::sin(wholeTurn * (9.0f * v + 2.2f * warp));
  const float fibre = tiledTurbulence(u, v, 6, 128, 2, seed + 7);
  const float pores = smoothStep(0.72f, 0.9f, tiledNoise(u, v, 24, 256, seed + 13));
  const float tone = std::clamp(0.45f * rings + 0.4f * fibre + 0.25f * warp, 0.0f, 1.0f);
  return {glm::mix(light, dark, tone) * (1.0f - 0.3f * pores), 0.38f + 0.12f * fibre + 0.12f * pores,
          -0.00008f * pores - 0.00004f * fibre};
}

/// Sixteen rows of oak boards, two boards per row.
SurfacePoint parquet(float u, float v) {
  constexpr int rows = 16;
  constexpr float side = static_cast<float>(SalonTextures::parquet);
  const float y = v * rows;
  const int row = static_cast<int>(y);
  const float along = u * 2.0f + hashed(row, 0, 3);
  const int board = static_cast<int>(std::floor(along)) % 2;
  const auto seed = static_cast<std::uint32_t>(row * 2 + board + 100);
  const float pick = hashed(row, board, 5);
  const glm::vec3 light = glm::mix(glm::vec3(0.46f, 0.29f, 0.155f), glm::vec3(0.38f, 0.22f, 0.11f), pick);
  const glm::vec3 dark = glm::mix(glm::vec3(0.30f, 0.165f, 0.08f), glm::vec3(0.22f, 0.115f, 0.052f), pick);
  // Each board is a piece of the grain of its own.
  SurfacePoint point = woodGrain(u, fractionOf(v * 1.0f + 0.37f * pick), light, dark, seed);
  const float fromSide = std::min(fractionOf(y), 1.0f - fractionOf(y)) * side / rows;
  const float fromEnd = std::min(fractionOf(along), 1.0f - fractionOf(along)) * side / 2.0f;
  const float edge = std::min(fromSide, fromEnd);
  const float joint = 1.0f - smoothStep(0.0004f, 0.0022f, edge);
  point.albedo *= 1.0f - 0.75f * joint;
  point.roughness = glm::mix(0.3f + 0.12f * (point.roughness - 0.38f) + 0.05f * pick, 0.8f, joint);
  point.height -= 0.0012f * joint;
  return point;
}

SurfacePoint walnut(float u, float v) {
  SurfacePoint point = woodGrain(u, v, {0.235f, 0.125f, 0.066f}, {0.105f, 0.05f, 0.027f}, 41);
  point.roughness -= 0.06f;
  return point;
}

/// Smoothed by hand: broad strokes and a fine grain.
SurfacePoint plaster(float u, float v) {
  const float strokes = tiledTurbulence(u, v, 5, 5, 4, 11), grain = tiledNoise(u, v, 128, 128, 17);
  return {glm::vec3(0.79f, 0.76f, 0.70f) * (0.96f + 0.08f * strokes), 0.85f,
          0.0012f * strokes + 0.00005f * grain};
}

/// Slabs in four courses, three to a course.
SurfacePoint paving(float u, float v) {
  constexpr int courses = 4, slabs = 3;
  constexpr float side = static_cast<float>(SalonTextures::paving);
  const float y = v * courses + 0.04f * (tiledNoise(u, v, 24, 24, 83) - 0.5f);
  const int course = (static_cast<int>(std::floor(y)) + courses) % courses;
  const float x = u * slabs + hashed(course, 1, 9) + 0.04f * (tiledNoise(u, v, 24, 24, 84) - 0.5f);
  const int slab = (static_cast<int>(std::floor(x)) + slabs) % slabs;
  const float pick = hashed(course, slab, 21);
  const float edge = std::min(std::min(fractionOf(y), 1.0f - fractionOf(y)) * side / courses,
                              std::min(fractionOf(x), 1.0f - fractionOf(x)) * side / slabs);
  const float joint = 1.0f - smoothStep(0.004f, 0.013f, edge), worn = 1.0f - smoothStep(0.01f, 0.05f, edge);
  const float clouds = tiledTurbulence(u, v, 8, 8, 4, 31), grain = tiledNoise(u, v, 170, 170, 37);
  const glm::vec3 stone = glm::mix(glm::vec3(0.52f, 0.46f, 0.37f), glm::vec3(0.40f, 0.37f, 0.32f), pick);
  SurfacePoint point{stone * (0.72f + 0.42f * clouds + 0.08f * grain), 0.8f,
                     0.003f * clouds + 0.0006f * grain - 0.003f * worn - 0.008f * joint};
  point.albedo = glm::mix(point.albedo, glm::vec3(0.17f, 0.15f, 0.11f) * (0.7f + 0.6f * clouds), joint);
  return point;
}

/// Squared limestone in eight courses, four blocks to a course.
SurfacePoint ashlar(float u, float v) {
  constexpr int courses = 8, blocks = 4;
  constexpr float side = static_cast<float>(SalonTextures::ashlar);
  const float wobble = 0.05f * (tiledNoise(u, v, 32, 32, 91) - 0.5f);
  const float y = v * courses + wobble;
  const int course = (static_cast<int>(std::floor(y)) + courses) % courses;
  const float x = u * blocks + (course % 2 == 0 ? 0.0f : 0.5f) + 0.2f * hashed(course, 2, 4) + wobble;
  const int block = (static_cast<int>(std::floor(x)) + blocks) % blocks;
  const float pick = hashed(course, block, 63);
  const float edge = std::min(std::min(fractionOf(y), 1.0f - fractionOf(y)) * side / courses,
                              std::min(fractionOf(x), 1.0f - fractionOf(x)) * side / blocks);
  const float joint = 1.0f - smoothStep(0.003f, 0.014f, edge);
  const float clouds = tiledTurbulence(u, v, 6, 6, 5, 71);
  const glm::vec3 stone = glm::mix(glm::vec3(0.66f, 0.54f, 0.37f), glm::vec3(0.55f, 0.43f, 0.29f), pick);
  SurfacePoint point{stone * (0.72f + 0.45f * clouds), 0.9f,
                     0.006f * clouds + 0.004f * pick - 0.009f * joint};
  point.albedo = glm::mix(point.albedo, glm::vec3(0.5f, 0.43f, 0.33f) * (0.6f + 0.4f * clouds), joint);
  return point;
}

/// A plain weave of 32 x 32 threads.
SurfacePoint weave(float u, float v) {
  constexpr float threads = 32.0f;
  const float x = u * threads, y = v * threads;
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const float fx = fractionOf(x) - 0.5f, fy = fractionOf(y) - 0.5f;
  const bool warpOnTop = (ix + iy) % 2 == 0;
  const float across = warpOnTop ? fx : fy, along = warpOnTop ? fy : fx;
  const float round = std::sqrt(std::max(0.0f, 1.0f - 3.6f * across * across)) *
                      (0.7f + 0.3f * std::cos(wholeTurn * 0.5f * along));
  const float thick = hashed(warpOnTop ? ix : iy, warpOnTop ? 0 : 1, 29);
  return {glm::vec3(0.86f + 0.14f * thick) * (0.7f + 0.3f * round), 0.95f, 0.0011f * round};
}

/// A wool rug: a field of lozenges within three borders. The texture covers it once, u along.
SurfacePoint rug(float u, float v) {
  const glm::vec3 red(0.30f, 0.045f, 0.032f), blue(0.035f, 0.06f, 0.13f), sand(0.52f, 0.40f, 0.24f),
      rust(0.40f, 0.14f, 0.05f);
  constexpr float length = 2.6f, width = 1.7f;
  const float x = u * length, y = v * width;
  const float edge = std::min(std::min(x, length - x), std::min(y, width - y));
  // Knots are 8 mm wide: colours are chosen per knot.
  const auto knot = [](float t) { return (std::floor(t / 0.008f) + 0.5f) * 0.008f; };
  const float kx = knot(x), ky = knot(y), kEdge = knot(edge);
  glm::vec3 color = red;
  if (kEdge < 0.04f) {
    color = blue;
  } else if (kEdge < 0.056f) {
    color = sand;
  } else if (kEdge < 0.23f) {
    const float s =
        std::abs(fractionOf((kx + ky) / 0.176f) - 0.5f) + std::abs(fractionOf((kx - ky) / 0.176f) - 0.5f);
    color = s < 0.28f ? sand : s < 0.4f ? rust : blue;
  } else if (kEdge < 0.246f) {
    color = sand;
  } else {
    const float cx = std::abs(kx - 0.5f * length), cy = std::abs(ky - 0.5f * width);
    const float medallion = cx / 0.62f + cy / 0.5f;
    const float lattice = std::abs(fractionOf((kx - 1.3f) / 0.2f + 0.5f) - 0.5f) +
                          std::abs(fractionOf((ky - 0.85f) / 0.2f + 0.5f) - 0.5f);
    if (medallion < 1.0f) {
      color = medallion > 0.93f ? sand : medallion < 0.3f ? rust : medallion < 0.36f ? sand : blue;
      if (color == blue && lattice < 0.16f) color = sand;
    } else if (lattice < 0.1f) {
      color = sand;
    } else if (lattice < 0.2f) {
      color = rust;
    }
  }
  const float fade = tiledTurbulence(u, v, 6, 4, 4, 47),
              tuft = hashed(static_cast<int>(x / 0.004f), static_cast<int>(y / 0.004f), 53);
  return {color * (0.75f + 0.35f * fade + 0.25f * tuft), 1.0f, 0.0015f * tuft + 0.004f * fade};
}

/// Lines of a brush along u.
SurfacePoint brushed(float u, float v) {
  const float lines = tiledTurbulence(u, v, 3, 96, 2, 19);
  return {glm::vec3(0.94f + 0.06f * lines), 0.26f + 0.16f * lines, 0.00002f * lines};
}

/// A landscape in oil: hills under an evening sky.
SurfacePoint landscape(float u, float v) {
  const auto ridge = [&](float base, float rise, int cells, std::uint32_t seed) {
    return base - rise * tiledTurbulence(u, 0.0f, cells, 1, 4, seed);
  };
  const float brush = tiledTurbulence(u, v, 16, 40, 3, 97);
  glm::vec3 color =
      glm::mix(glm::vec3(0.16f, 0.25f, 0.36f), glm::vec3(0.75f, 0.52f, 0.30f), smoothStep(0.0f, 0.5f, v));
  color = glm::mix(color, glm::vec3(0.8f, 0.66f, 0.5f),
                   0.6f * smoothStep(0.5f, 0.75f, tiledTurbulence(u, v, 3, 8, 4, 23)));
  if (v > ridge(0.62f, 0.28f, 3, 61)) color = {0.16f, 0.21f, 0.25f};
  if (v > ridge(0.72f, 0.22f, 4, 67)) color = {0.13f, 0.17f, 0.10f};
  if (v > ridge(0.88f, 0.2f, 3, 73))
    color =
        glm::mix(glm::vec3(0.20f, 0.19f, 0.07f), glm::vec3(0.30f, 0.22f, 0.08f), smoothStep(0.7f, 1.0f, v));
  return {color * (0.75f + 0.5f * brush), 0.45f, 0.0008f * brush};
}

int plainMaterialOf(GltfBuilder& builder, const std::string& name, const glm::vec3& color, float roughness,
                    float specular = 1.0f) {
  return builder.addPlain(
      {.name = name, .baseColor = glm::vec4(color, 1.0f), .roughness = roughness, .specular = specular});
}

/// Adds the materials that have textures.
void addTextured(GltfBuilder& builder, SalonMaterials& m) {
  const auto maps = [&](const std::string& name, int size, double side, const SurfacePattern& pattern) {
    const SurfaceMaps images = makeSurfaceMaps(name, size, side, pattern);
    return builder.addMaps(images.albedo, images.roughness, images.normals);
  };
  const auto mapped = [&](const std::string& name, const MapIndices& textures, const glm::vec3& tint,
                          float specular) {
    return builder.addMapped({.name = name, .baseColor = glm::vec4(tint, 1.0f), .specular = specular},
                             textures);
  };
  const glm::vec3 white(1.0f);
  m.parquet = mapped("Parquet", maps("Parquet", 768, SalonTextures::parquet, parquet), white, 1.0f);
  const MapIndices strokes = maps("Plaster", 256, SalonTextures::plaster, plaster);
  m.plaster = mapped("Plaster", strokes, white, 0.0f);
  m.walnut = mapped("Walnut", maps("Walnut", 512, SalonTextures::wood, walnut), white, 1.0f);
  const MapIndices cloth = maps("Weave", 256, SalonTextures::fabric, weave);
  m.linen = mapped("Linen", cloth, {0.62f, 0.55f, 0.43f}, 0.0f);
  m.velvet = mapped("Green cloth", cloth, {0.075f, 0.16f, 0.125f}, 0.0f);
  builder.addSheen(m.velvet, {0.18f, 0.3f, 0.25f}, 0.5f);
  builder.addSheen(m.linen, {0.2f, 0.19f, 0.17f}, 0.6f);
  m.rug = mapped("Rug", maps("Rug", 512, 2.1, rug), white, 0.0f);
  builder.addSheen(m.rug, {0.1f, 0.08f, 0.07f}, 0.6f);
  const MapIndices brush = maps("Brushed", 256, 0.1, brushed);
  m.brass =
      builder.addMapped({.name = "Brass", .baseColor = {0.83f, 0.60f, 0.29f, 1.0f}, .metallic = 1.0f}, brush);
  m.paving = mapped("Paving", maps("Paving", 512, SalonTextures::paving, paving), white, 0.5f);
  m.ashlar = mapped("Ashlar", maps("Ashlar", 512, SalonTextures::ashlar, ashlar), white, 0.0f);
  m.stucco = mapped("Stucco", MapIndices{-1, -1, strokes.normals}, {0.66f, 0.44f, 0.26f}, 0.0f);
  m.picture = mapped("Landscape", maps("Landscape", 256, 0.9, landscape), white, 1.0f);
}

void addUntextured(GltfBuilder& builder, SalonMaterials& m) {
  m.ceiling = plainMaterialOf(builder, "Ceiling", glm::vec3(0.78f, 0.77f, 0.74f), 1.0f, 0.0f);
  m.paint = plainMaterialOf(builder, "White paint", glm::vec3(0.74f, 0.73f, 0.69f), 0.4f);
  m.curtain = builder.addPlain(
      {.name = "Curtain", .baseColor = {0.74f, 0.70f, 0.62f, 1.0f}, .specular = 0.0f, .doubleSided = true});
  m.gilt = builder.addPlain(
      {.name = "Gilt", .baseColor = {0.72f, 0.5f, 0.22f, 1.0f}, .metallic = 1.0f, .roughness = 0.35f});
  m.mirror = builder.addMirror("Mirror", {0.9f, 0.9f, 0.89f});
  m.glass = builder.addGlass("Glass", 1.5f);
  m.porcelain = plainMaterialOf(builder, "Porcelain", glm::vec3(0.74f, 0.74f, 0.71f), 0.15f);
  m.shade = builder.addPlain({.name = "Lamp shade",
                              .baseColor = {0.62f, 0.5f, 0.34f, 1.0f},
                              .specular = 0.0f,
                              .emission = {2.6f, 1.5f, 0.62f}});
  m.shadeInside =
      plainMaterialOf(builder, "Inside of the shade", glm::vec3(0.02f, 0.016f, 0.012f), 1.0f, 0.0f);
  m.celadon = plainMaterialOf(builder, "Celadon", glm::vec3(0.16f, 0.22f, 0.19f), 0.35f);
  m.terracotta = plainMaterialOf(builder, "Terracotta", {0.48f, 0.20f, 0.105f}, 0.8f, 0.5f);
  m.earth = plainMaterialOf(builder, "Earth", {0.07f, 0.05f, 0.035f}, 1.0f, 0.0f);
  m.bark = plainMaterialOf(builder, "Bark", {0.17f, 0.13f, 0.095f}, 1.0f, 0.0f);
  const glm::vec3 greens[] = {{0.10f, 0.17f, 0.035f}, {0.065f, 0.125f, 0.035f}, {0.15f, 0.20f, 0.05f}};
  for (int i = 0; i < 3; ++i)
    m.leaves[i] = builder.addPlain({.name = "Leaves " + std::to_string(i),
                                    .baseColor = glm::vec4(greens[i] * 1.6f, 1.0f),
                                    .specular = 0.0f,
                                    .doubleSided = true});
  m.orange = plainMaterialOf(builder, "Orange peel", {0.75f, 0.26f, 0.03f}, 0.45f);
  m.lemon = plainMaterialOf(builder, "Lemon peel", {0.78f, 0.58f, 0.06f}, 0.45f);
  m.paper = plainMaterialOf(builder, "Paper", {0.74f, 0.69f, 0.58f}, 1.0f, 0.0f);
  const glm::vec3 bindings[] = {{0.28f, 0.05f, 0.04f}, {0.06f, 0.11f, 0.17f}, {0.10f, 0.15f, 0.08f},
                                {0.42f, 0.30f, 0.14f}, {0.55f, 0.48f, 0.37f}, {0.13f, 0.075f, 0.05f}};
  for (int i = 0; i < 6; ++i)
    m.books[i] = plainMaterialOf(builder, "Binding " + std::to_string(i), bindings[i], 0.55f, 0.6f);
}

}  // namespace

SalonMaterials addSalonMaterials(GltfBuilder& builder) {
  SalonMaterials materials{};
  addTextured(builder, materials);
  addUntextured(builder, materials);
  return materials;
}

}  // namespace prelight
