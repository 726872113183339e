#include "charts/file_islands.h"

#include <gtest/gtest.h>

#include <numbers>

#include "charts/check_layout.h"
#include "charts/make_light_map_layout.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// A scene of test::sceneOf with a TEXCOORD_1 of its own for the first primitive.
struct Coordinated {
  Scene scene;
  CompiledScene compiled;
};

Coordinated withCoords(CompiledScene compiled, std::vector<glm::vec2> coords) {
  Coordinated made;
  made.scene.meshes.resize(1);
  made.scene.meshes[0].primitives.resize(1);
  made.scene.meshes[0].primitives[0].texCoords1 = std::move(coords);
  made.compiled = std::move(compiled);
  made.compiled.primitives[0].mesh = 0;
  made.compiled.primitives[0].name = "yard";
  return made;
}

/// Coordinates [vertex] of test::ground: the position as seen from above, scaled to 0..1 and then mapped.
std::vector<glm::vec2> coordsFromAbove(const CompiledScene& ground, float half, const glm::mat2& map,
                                       const glm::vec2& origin = {0.0f, 0.0f}) {
  std::vector<glm::vec2> coords;
  for (const glm::vec3& p : ground.positions)
    coords.push_back(origin + map * (glm::vec2(p.x, p.z) / (2.0f * half) + 0.5f));
  return coords;
}

LightMapLayout layOut(const Coordinated& made, double texelSize, bool* fromFile = nullptr) {
  LightMapLayoutRequest request;
  request.texelSize = texelSize;
  const LightMapCharts charts = makeLightMapCharts(made.scene, made.compiled, request);
  if (fromFile != nullptr) *fromFile = charts.charts[0].fromFile;
  const LightMapLayout layout = layOutLightMap(made.compiled, charts);
  test::checkLayout(made.compiled, layout, charts.texelSize, "coordinates");
  return layout;
}

std::string reasonFor(const Coordinated& made) {
  const LightMapCharts charts = makeLightMapCharts(made.scene, made.compiled, {});
  return charts.replaced.empty() ? std::string() : charts.replaced[0].reason;
}

TEST(FileIslands, UnitOfTheTexture_IsAsManyMetresAsItMayBe) {
  for (const float half : {0.01f, 0.5f, 15.0f, 20.0f, 300.0f})
    for (const float unit : {0.9f, 0.3f, 0.002f}) {
      const CompiledScene ground = test::ground(4, half);
      bool fromFile = false;
      const LightMapLayout layout =
          layOut(withCoords(ground, coordsFromAbove(ground, half, glm::mat2(unit), {0.1f * unit, 0.0f})),
                 half / 32.0, &fromFile);
      EXPECT_TRUE(fromFile) << half << " " << unit;
      EXPECT_EQ(layout.width, 65) << half << " " << unit;
      EXPECT_EQ(layout.height, 65) << half << " " << unit;
    }
}

TEST(FileIslands, NoTexelSizeAskedFor_GivesTheTexelsOfOwnCharts) {
  for (const float half : {0.2f, 200.0f}) {
    const CompiledScene ground = test::ground(1, half);
    Coordinated made = withCoords(ground, coordsFromAbove(ground, half, glm::mat2(1.0f)));
    test::append(made.compiled, test::box(1, glm::vec3(-0.1f * half), glm::vec3(0.1f * half), false));
    const LightMapLayout with = makeLightMapLayout(made.scene, made.compiled, {}),
                         without = makeLightMapLayout(Scene{}, made.compiled, {});
    EXPECT_EQ(with.width, without.width);
    EXPECT_EQ(with.height, without.height);
    EXPECT_EQ(with.texels.size(), without.texels.size());
  }
}

TEST(FileIslands, EvenStretch_IsUndone) {
  // The maps shear or mirror, and shrink one axis. A square of the surface still becomes a square of texels.
  const glm::mat2 shear(0.8f, 0.05f, 0.1f, 0.08f), mirror(-0.5f, 0.0f, 0.0f, 0.1f);
  const CompiledScene ground = test::ground(4, 1.0f);
  for (const glm::mat2& map : {shear, mirror}) {
    bool fromFile = false;
    const LightMapLayout layout =
        layOut(withCoords(ground, coordsFromAbove(ground, 1.0f, map, {map[0].x < 0.0f ? 0.6f : 0.0f, 0.0f})),
               0.05, &fromFile);
    EXPECT_TRUE(fromFile);
    EXPECT_EQ(layout.width, 41);
    EXPECT_EQ(layout.height, 41);
  }
}

TEST(FileIslands, UnevenStretch_IsRefused) {
  const CompiledScene ground = test::ground(8, 1.0f);
  std::vector<glm::vec2> coords = coordsFromAbove(ground, 1.0f, glm::mat2(1.0f));
  for (glm::vec2& uv : coords) uv.x = std::pow(uv.x, 6.0f);
  EXPECT_NE(reasonFor(withCoords(ground, coords)), "");
}

TEST(FileIslands, ATriangleEach_MakesWayForOwnCharts) {
  CompiledScene box = test::box(1, glm::vec3(0.0f), glm::vec3(1.0f), true);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::vec2> coords;
  for (const glm::uvec3& t : box.triangles) {
    const auto at = static_cast<std::uint32_t>(positions.size());
    const glm::vec2 corner(0.25f * float(triangles.size() % 4), 0.3f * float(triangles.size() / 4));
    for (int k = 0; k < 3; ++k) positions.push_back(box.positions[t[k]]);
    for (const glm::vec2& step : {glm::vec2(0, 0), glm::vec2(0.2f, 0), glm::vec2(0.2f, 0.2f)})
      coords.push_back(corner + step);
    triangles.push_back({at, at + 1, at + 2});
  }
  const Coordinated made = withCoords(test::sceneOf(positions, triangles), coords);
  const LightMapCharts charts = makeLightMapCharts(made.scene, made.compiled, {});
  EXPECT_EQ(charts.charts.size(), 6u);
  ASSERT_EQ(charts.replaced.size(), 1u);
  EXPECT_NE(charts.replaced[0].reason.find("12 pieces"), std::string::npos) << charts.replaced[0].reason;
}

TEST(FileIslands, CoordinatesThatAreNotUsed_AreNamedWithTheReason) {
  const CompiledScene ground = test::ground(4, 1.0f);
  const auto coords = [&](const glm::mat2& map, const glm::vec2& origin) {
    return withCoords(ground, coordsFromAbove(ground, 1.0f, map, origin));
  };
  EXPECT_EQ(reasonFor(coords(glm::mat2(0.9f), {0.05f, 0.05f})), "");
  EXPECT_NE(reasonFor(coords(glm::mat2(1.02f), {0.0f, 0.0f})).find("outside 0..1"), std::string::npos);
  EXPECT_NE(reasonFor(coords(glm::mat2(0.0f), {0.5f, 0.5f})).find("no area"), std::string::npos);
  std::vector<glm::vec2> folded = coordsFromAbove(ground, 1.0f, glm::mat2(1.0f));
  for (glm::vec2& uv : folded) uv.x = std::abs(uv.x - 0.5f);
  EXPECT_NE(reasonFor(withCoords(ground, folded)).find("more than once"), std::string::npos);

  const LightMapCharts charts =
      makeLightMapCharts(coords(glm::mat2(1.02f), {}).scene, coords(glm::mat2(1.02f), {}).compiled, {});
  EXPECT_NE(replacedText(charts.replaced).find("\"yard\""), std::string::npos)
      << replacedText(charts.replaced);
  EXPECT_EQ(replacedText({}), "");
}

TEST(FileIslands, CutLength_IsThatOfTheOutline) {
  const LightMapCharts charts = makeLightMapCharts(Scene{}, test::ground(6, 1.5f), {});
  ASSERT_EQ(charts.charts.size(), 1u);
  EXPECT_NEAR(cutLength(charts.charts[0]), 12.0, 1e-5);
}

}  // namespace
}  // namespace prelight
